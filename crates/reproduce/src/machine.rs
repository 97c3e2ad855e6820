//! The processor of timings, and the median of repeated times.

/// The processor.
pub(crate) fn processor() -> String {
    let build = if cfg!(debug_assertions) {
        ", debug build"
    } else {
        ""
    };
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == "model name").then(|| value.trim().to_owned())
    });
    let model = model.unwrap_or_else(|| format!("a {} processor", std::env::consts::ARCH));
    format!("{model}{build}")
}

/// The middle one; `times` are sorted.
pub(crate) fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
