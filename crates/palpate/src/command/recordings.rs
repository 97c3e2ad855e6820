//! The recordings that a command is given: files and folders, of this project and of other programs.

use std::path::PathBuf;

use clap::Args;

/// Which recordings, and what they do not say themselves.
#[derive(Debug, Args)]
pub(crate) struct Recordings {
    /// Recordings, or folders of recordings; instruments' own files and tables written by other programs are read too.
    #[arg(required = true, value_name = "RECORDING.csv")]
    paths: Vec<PathBuf>,
    /// The time column in another program's table; default: found by its name.
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// The depth column.
    #[arg(long, value_name = "COLUMN")]
    depth: Option<String>,
    /// The force column.
    #[arg(long, value_name = "COLUMN")]
    force: Option<String>,
    /// The unit of the depth, if the column name does not state it: m, mm, um, nm.
    #[arg(long, value_name = "UNIT")]
    depth_unit: Option<String>,
    /// The unit of the force, if the column name does not state it: N, mN, uN, nN.
    #[arg(long, value_name = "UNIT")]
    force_unit: Option<String>,
    /// A header key that the files do not state: --set indenter_radius_m=0.001
    #[arg(long = "set", value_name = "KEY=VALUE")]
    said: Vec<String>,
}

impl Recordings {
    /// The same for a job.
    pub(crate) fn request(&self) -> palpate_jobs::Recordings {
        palpate_jobs::Recordings {
            paths: self.paths.clone(),
            texts: Vec::new(),
            time: self.time.clone(),
            depth: self.depth.clone(),
            force: self.force.clone(),
            depth_unit: self.depth_unit.clone(),
            force_unit: self.force_unit.clone(),
            header_entries: self.said.clone(),
        }
    }
}
