//! The memory limit of a job: four fifths of the smallest of the machine's free memory, the memory left within the
//! limits of the process (`ulimit -v`, `ulimit -d`), and that left within the limits of its control groups (a
//! container, a batch system).
//!
//! *How we know*: `memory::tests`, and `limits::precompute_refuses_what_a_limit_of_memory_forbids` of the command.
//!
//! *Limits*: those of the process and of control groups are known on Linux alone, from `/proc` and `/sys/fs/cgroup`.
//! Another program may take the memory meanwhile; large matrices are allocated so that this is an error.

use std::fs;
use std::path::{Path, PathBuf};

/// The fraction of the available memory that a job may use [-].
const PART: f64 = 0.8;

/// Memory that a job may use now [bytes]; none where the system does not report it.
pub fn offered() -> Option<usize> {
    let left = [free(), left_to_process(), left_to_groups(Path::new("/"))];
    let least = left.into_iter().flatten().min()?;
    Some((PART * least as f64) as usize)
}

/// Free memory of the machine.
fn free() -> Option<u64> {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    // Zero where the system does not report it.
    Some(system.available_memory()).filter(|&free| free > 0)
}

/// Memory left within the limits of this process.
fn left_to_process() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    left_by_limits(&limits, &status)
}

/// Limits of a process in `/proc`, and the quantities that count towards each.
const LIMITS: [(&str, &str); 2] = [
    ("Max address space", "VmSize:"),
    ("Max data size", "VmData:"),
];

fn left_by_limits(limits: &str, status: &str) -> Option<u64> {
    let left = |(limit, used): &(&str, &str)| {
        let soft = first_number(limits, limit)?;
        let used = 1024 * first_number(status, used)?;
        Some(soft.saturating_sub(used))
    };
    LIMITS.iter().filter_map(left).min()
}

/// The first word behind a name at the beginning of a line, when it is a number; `unlimited` is none.
fn first_number(text: &str, name: &str) -> Option<u64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_ascii_whitespace().next()?.parse().ok()
}

/// Memory left within the limits of the control groups of this process; `root` is that of the file system.
fn left_to_groups(root: &Path) -> Option<u64> {
    let groups = fs::read_to_string(root.join("proc/self/cgroup")).ok()?;
    let left = groups.lines().filter_map(|line| {
        let mut fields = line.splitn(3, ':').skip(1);
        let (controllers, group) = (fields.next()?, fields.next()?);
        let version = match controllers {
            "" => &TWO,
            _ if controllers.split(',').any(|name| name == "memory") => &ONE,
            _ => return None,
        };
        version.left(&root.join(version.mount), group)
    });
    left.min()
}

/// Files in which a version of control groups reports limits.
struct Version {
    /// Where the groups are mounted, below the root.
    mount: &'static str,
    limit: &'static str,
    used: &'static str,
    /// The line of `memory.stat` with the page cache within the used memory, which is freed on demand.
    copies: &'static str,
}

const ONE: Version = Version {
    mount: "sys/fs/cgroup/memory",
    limit: "memory.limit_in_bytes",
    used: "memory.usage_in_bytes",
    copies: "total_inactive_file",
};

const TWO: Version = Version {
    mount: "sys/fs/cgroup",
    limit: "memory.max",
    used: "memory.current",
    copies: "inactive_file",
};

impl Version {
    /// The smallest remainder of a group and those above it. In a container the group may have its name outside; then
    /// the mount itself is the container's.
    fn left(&self, mount: &Path, group: &str) -> Option<u64> {
        let group: PathBuf = mount.join(group.trim_start_matches('/'));
        let up_to_mount = group.ancestors().take_while(|at| at.starts_with(mount));
        let left = |folder: &Path| {
            let number = |name: &str| -> Option<u64> {
                let text = fs::read_to_string(folder.join(name)).ok()?;
                text.trim().parse().ok()
            };
            let limit = number(self.limit)?;
            let stat = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
            let copies = first_number(&stat, self.copies).unwrap_or(0);
            let used = number(self.used)?.saturating_sub(copies);
            Some(limit.saturating_sub(used))
        };
        up_to_mount.filter_map(left).min()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS_TEXT: &str = "\
Limit                     Soft Limit           Hard Limit           Units
Max cpu time              unlimited            unlimited            seconds
Max data size             unlimited            unlimited            bytes
Max address space         2000000000           unlimited            bytes
";

    #[test]
    fn limits_of_the_process_count_less_what_it_has() {
        let status = "VmPeak:\t 600000 kB\nVmSize:\t  500000 kB\nVmData:\t  100000 kB\n";
        let left = left_by_limits(LIMITS_TEXT, status);
        assert_eq!(left, Some(2_000_000_000 - 1024 * 500_000));
        let unlimited = LIMITS_TEXT.replace("2000000000", "unlimited ");
        assert_eq!(left_by_limits(&unlimited, status), None);
        let data = unlimited.replace(
            "Max data size             unlimited",
            "Max data size  100000",
        );
        assert_eq!(left_by_limits(&data, status), Some(0));
    }

    fn written(root: &Path, files: &[(&str, &str)]) {
        for (path, text) in files {
            let path = root.join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
    }

    /// Judge: the least of the groups from the process's own up to the mount, of which one has no limit.
    #[test]
    fn control_groups_of_version_two() {
        let root = tempfile::tempdir().unwrap();
        let own = "sys/fs/cgroup/user.slice/job";
        written(
            root.path(),
            &[
                ("proc/self/cgroup", "0::/user.slice/job\n"),
                (&format!("{own}/memory.max"), "max\n"),
                (&format!("{own}/memory.current"), "1000\n"),
                ("sys/fs/cgroup/user.slice/memory.max", "5000\n"),
                ("sys/fs/cgroup/user.slice/memory.current", "2000\n"),
                (
                    "sys/fs/cgroup/user.slice/memory.stat",
                    "anon 1500\ninactive_file 500\n",
                ),
            ],
        );
        assert_eq!(left_to_groups(root.path()), Some(3500));
        fs::write(root.path().join(own).join("memory.max"), "1200\n").unwrap();
        assert_eq!(left_to_groups(root.path()), Some(200));
    }

    /// A container whose group has a name that does not exist inside of it.
    #[test]
    fn control_groups_of_version_one() {
        let root = tempfile::tempdir().unwrap();
        let mount = "sys/fs/cgroup/memory";
        written(
            root.path(),
            &[
                ("proc/self/cgroup", "7:cpu:/\n5:memory:/docker/0123\n0::/\n"),
                (&format!("{mount}/memory.limit_in_bytes"), "8000\n"),
                (&format!("{mount}/memory.usage_in_bytes"), "9000\n"),
                (
                    &format!("{mount}/memory.stat"),
                    "inactive_file 1\ntotal_inactive_file 4000\n",
                ),
            ],
        );
        assert_eq!(left_to_groups(root.path()), Some(3000));
        assert_eq!(left_to_groups(&root.path().join("nowhere")), None);
    }
}
