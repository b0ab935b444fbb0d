//! How much memory this machine has.

/// Memory that a run may use (bytes): the machine's, or its container's limit.
/// `None` where neither can be read.
pub(crate) fn available() -> Option<u64> {
    let machine = std::fs::read_to_string("/proc/meminfo").ok().and_then(|text| total(&text));
    let container = std::fs::read_to_string("/sys/fs/cgroup/memory.max")
        .ok()
        .and_then(|text| text.trim().parse::<u64>().ok());
    match (machine, container) {
        (Some(machine), Some(container)) => Some(machine.min(container)),
        (machine, container) => machine.or(container),
    }
}

/// `MemTotal` of `/proc/meminfo` (bytes).
fn total(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kibibytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

/// Bytes with a unit, for messages.
pub(crate) fn text(bytes: f64) -> String {
    match bytes {
        b if b < 1e6 => format!("{:.0} kB", b / 1e3),
        b if b < 1e9 => format!("{:.0} MB", b / 1e6),
        b if b < 1e14 => format!("{:.1} GB", b / 1e9),
        b => format!("{b:.1e} bytes"),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn meminfo_is_read() {
        let text = "MemTotal:       16303428 kB\nMemFree:  1 kB\n";
        assert_eq!(super::total(text), Some(16_303_428 * 1024));
        assert_eq!(super::total("nothing"), None);
    }
}
