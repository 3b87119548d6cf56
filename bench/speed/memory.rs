//! How much memory this process has, in bytes, from Linux's /proc; none elsewhere.

use std::fs;

/// What it holds now (`VmRSS`).
pub fn resident() -> Option<u64> {
    entry("VmRSS:")
}

/// The most it has held so far (`VmHWM`).
pub fn peak() -> Option<u64> {
    entry("VmHWM:")
}

fn entry(key: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}
