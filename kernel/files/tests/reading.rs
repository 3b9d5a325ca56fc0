//! Files that are too large for the memory of the machine are not read.

use proctor_files::reading::{NotUtf8, read_within, stream_to_string};
use proctor_kernel::memory::Memory;
use std::io::ErrorKind;
use std::path::Path;

#[test]
fn a_file_that_is_too_large_is_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path
    };
    let memory = Memory::of(4096);
    assert_eq!(
        read_within(&file("small", "12345678"), memory).expect("fits"),
        b"12345678"
    );
    let error = read_within(&file("large", &"x".repeat(1000)), memory).expect_err("too large");
    assert_eq!(error.kind(), ErrorKind::OutOfMemory);
    assert!(error.to_string().contains("4.0 KiB"), "{error}");
}

/// A device has no length and no end.
#[cfg(target_os = "linux")]
#[test]
fn a_device_without_end_is_not_read_for_ever() {
    let error = read_within(Path::new("/dev/zero"), Memory::of(1 << 20)).expect_err("no end");
    assert_eq!(error.kind(), ErrorKind::OutOfMemory);
}

#[test]
fn a_byte_that_is_no_text_is_told_with_line_and_column() {
    let bytes: &[u8] = b"one\ntw\xc3\xb6 \xff\n";
    let error = stream_to_string(bytes).expect_err("no UTF-8");
    assert_eq!(error.kind(), ErrorKind::InvalidData);
    let inner = error.get_ref().and_then(|e| e.downcast_ref::<NotUtf8>());
    let wanted = NotUtf8 {
        byte: 0xff,
        line: 2,
        column: 5,
    };
    assert_eq!(inner, Some(&wanted), "{error}");
    assert_eq!(stream_to_string(&bytes[..8]).expect("text"), "one\ntwö");
    // The first of two bytes at the very end.
    assert!(stream_to_string(&bytes[..7]).is_err());
}
