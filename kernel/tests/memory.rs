//! The memory of the machine, from files like those of Linux.

use proctor_kernel::memory::{Memory, words};
use std::fs;
use tempfile::TempDir;

/// A system of files with these contents.
fn system(files: &[(&str, &str)]) -> TempDir {
    let root = TempDir::new().expect("a folder");
    for (path, text) in files {
        let path = root.path().join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    }
    root
}

fn bytes(files: &[(&str, &str)]) -> u64 {
    Memory::of_files(system(files).path()).bytes()
}

const MEMINFO: (&str, &str) = (
    "proc/meminfo",
    "MemTotal:       2000 kB\nMemFree: 1 kB\nMemAvailable:   1000 kB\nCommitLimit: 900 kB\nCommitted_AS: 100 kB\n",
);

#[test]
fn without_a_word_of_the_system_the_documented_number_holds() {
    assert_eq!(bytes(&[]), Memory::ELSEWHERE);
    assert_eq!(Memory::ELSEWHERE, 16 * 1024 * 1024 * 1024);
}

#[test]
fn the_machine_has_what_is_available() {
    assert_eq!(bytes(&[MEMINFO]), 1000 * 1024);
}

#[test]
fn a_system_that_keeps_its_promises_has_what_it_may_still_promise() {
    let mode = |mode| ("proc/sys/vm/overcommit_memory", mode);
    assert_eq!(bytes(&[MEMINFO, mode("0\n")]), 1000 * 1024);
    assert_eq!(bytes(&[MEMINFO, mode("2\n")]), 800 * 1024);
}

#[test]
fn a_limit_of_the_address_space_counts() {
    let limits = (
        "proc/self/limits",
        "Limit                     Soft Limit           Hard Limit           Units\n\
         Max address space         600000               unlimited            bytes\n",
    );
    let status = ("proc/self/status", "Name:\tx\nVmSize:\t     100 kB\n");
    assert_eq!(bytes(&[MEMINFO, limits, status]), 600_000 - 102_400);
    let unlimited = (
        "proc/self/limits",
        "Max address space         unlimited            unlimited            bytes\n",
    );
    assert_eq!(bytes(&[MEMINFO, unlimited, status]), 1000 * 1024);
}

#[test]
fn the_groups_of_a_process_and_all_above_them_count() {
    let own = ("proc/self/cgroup", "0::/a/b\n");
    let group = |path, text| (path, text);
    // The one above has less left than the own one.
    let files = [
        MEMINFO,
        own,
        group("sys/fs/cgroup/a/b/memory.max", "max\n"),
        group("sys/fs/cgroup/a/memory.max", "500000\n"),
        group("sys/fs/cgroup/a/memory.current", "100000\n"),
    ];
    assert_eq!(bytes(&files), 400_000);
    // In a container the own group is the root of what is mounted.
    let files = [
        MEMINFO,
        ("proc/self/cgroup", "0::/../..\n"),
        group("sys/fs/cgroup/memory.max", "300000\n"),
    ];
    assert_eq!(bytes(&files), 300_000);
    let files = [
        MEMINFO,
        ("proc/self/cgroup", "5:cpu:/c\n4:hugetlb,memory:/c\n"),
        group("sys/fs/cgroup/memory/c/memory.limit_in_bytes", "200000\n"),
        group("sys/fs/cgroup/memory/c/memory.usage_in_bytes", "50000\n"),
    ];
    assert_eq!(bytes(&files), 150_000);
}

#[test]
fn this_machine_has_some() {
    assert!(Memory::of_machine().bytes() > 1 << 20);
}

#[test]
fn what_is_too_much_is_said_with_both_numbers() {
    let memory = Memory::of(3 << 30);
    assert_eq!(memory.require("a grid", f64::from(3 << 29) * 2.0), Ok(()));
    let error = memory.require("a grid", 6.5e10).expect_err("too much");
    assert_eq!(
        error.to_string(),
        "a grid would need 60.5 GiB of memory; accepted: at most the 3.0 GiB that are free"
    );
    for none in [f64::INFINITY, f64::NAN] {
        assert!(memory.require("a grid", none).is_err());
    }
}

#[test]
fn bytes_have_readable_units() {
    assert_eq!(words(512.0), "512 B");
    assert_eq!(words(1536.0), "1.5 KiB");
    assert_eq!(words(1e30), "8.271806125530277e5 YiB");
}
