//! Checkpoints: bit by bit, and every damage found.

use std::fs;
use std::path::PathBuf;

use proctor_files::output::checkpoint::{CHECKPOINT, Checkpoint, CheckpointError, VERSION};

use super::names;

fn sample() -> Checkpoint {
    let mut checkpoint = Checkpoint::new(0xfeed_beef_0123_4567);
    let bits = [
        0x7ff8_0000_0000_1234,
        0xfff0_0000_0000_0001,
        1,
        1 << 63,
        0x3ff0_0000_0000_0000,
    ];
    checkpoint.push("position", bits.map(f64::from_bits).to_vec());
    checkpoint.push("step", vec![u64::MAX]);
    checkpoint.push("offset", vec![i64::MIN, -1, 0, i64::MAX]);
    checkpoint.push("größe", b"text\n\0".to_vec());
    checkpoint.push("empty", Vec::<f64>::new());
    checkpoint
}

fn written() -> (tempfile::TempDir, PathBuf, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(CHECKPOINT);
    sample().write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    (folder, path, bytes)
}

#[test]
fn a_checkpoint_returns_bit_by_bit() {
    let (folder, path, bytes) = written();
    let read = Checkpoint::read(&path).unwrap();
    let bits = |checkpoint: &Checkpoint| -> Vec<u64> {
        checkpoint
            .values::<f64>("position")
            .unwrap()
            .iter()
            .map(|value| value.to_bits())
            .collect()
    };
    assert_eq!(bits(&read), bits(&sample()));
    assert_eq!(read.fingerprint, sample().fingerprint);
    assert_eq!(read.number::<u64>("step").unwrap(), u64::MAX);
    assert_eq!(
        read.array::<i64>("offset", 4).unwrap(),
        [i64::MIN, -1, 0, i64::MAX]
    );
    assert_eq!(read.values::<u8>("größe").unwrap(), b"text\n\0");
    assert!(read.array::<f64>("empty", 0).unwrap().is_empty());
    // The same checkpoint makes the same bytes.
    read.write(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), bytes);
    assert_eq!(names(folder.path()), [CHECKPOINT]);
}

#[test]
fn a_section_longer_than_all_buffers_returns() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(CHECKPOINT);
    let mut checkpoint = Checkpoint::new(1);
    checkpoint.push("x", (0..1_000_003).map(f64::from).collect());
    checkpoint.write(&path).unwrap();
    assert!(Checkpoint::read(&path).unwrap() == checkpoint);
}

#[test]
fn every_flipped_bit_is_found() {
    let (_folder, path, bytes) = written();
    for bit in 0..8 * bytes.len() {
        let mut damaged = bytes.clone();
        damaged[bit / 8] ^= 1 << (bit % 8);
        fs::write(&path, &damaged).unwrap();
        let error = Checkpoint::read(&path).unwrap_err();
        let as_expected = match bit / 8 {
            0..8 => matches!(error, CheckpointError::NotACheckpoint { .. }),
            8..12 => matches!(error, CheckpointError::OtherVersion { .. }),
            24..32 => matches!(
                error,
                CheckpointError::Truncated { .. } | CheckpointError::TooLong { .. }
            ),
            _ => matches!(error, CheckpointError::Checksum { .. }),
        };
        assert!(as_expected, "bit {bit}: {error:?}");
    }
}

#[test]
fn every_truncation_is_found() {
    let (_folder, path, bytes) = written();
    for length in 0..bytes.len() {
        fs::write(&path, &bytes[..length]).unwrap();
        let error = Checkpoint::read(&path).unwrap_err();
        if length == 0 {
            assert!(
                matches!(error, CheckpointError::NotACheckpoint { .. }),
                "{error:?}"
            );
        } else {
            assert!(
                matches!(error, CheckpointError::Truncated { .. }),
                "{length}: {error:?}"
            );
        }
    }
    fs::write(&path, [&bytes[..], b"x"].concat()).unwrap();
    assert!(matches!(
        Checkpoint::read(&path),
        Err(CheckpointError::TooLong { .. })
    ));
}

#[test]
fn another_version_another_file_and_no_file_are_told_apart() {
    let (folder, path, mut bytes) = written();
    bytes[8..12].copy_from_slice(&(VERSION + 1).to_le_bytes());
    fs::write(&path, &bytes).unwrap();
    let error = Checkpoint::read(&path).unwrap_err();
    assert!(matches!(error, CheckpointError::OtherVersion { found, .. } if found == VERSION + 1));
    fs::write(&path, "{\"mesh\": {}}").unwrap();
    assert!(
        Checkpoint::read(&path)
            .unwrap_err()
            .to_string()
            .ends_with("is not a checkpoint")
    );
    let error = Checkpoint::read(&folder.path().join("missing.bin")).unwrap_err();
    assert!(
        matches!(error, CheckpointError::Read { .. }) && error.to_string().contains("missing.bin")
    );
    assert!(matches!(
        Checkpoint::read(folder.path()),
        Err(CheckpointError::Read { .. })
    ));
}

/// A right checksum over a wrong count must not make the reader allocate or panic.
#[test]
fn nonsense_under_a_right_checksum_is_an_error() {
    let (_folder, path, mut bytes) = written();
    let count = 32 + 1 + 4 + "position".len();
    for nonsense in [u64::MAX, 1 << 61, 1 << 40] {
        bytes[count..count + 8].copy_from_slice(&nonsense.to_le_bytes());
        let end = bytes.len() - 4;
        let mut crc = flate2::Crc::new();
        crc.update(&bytes[..end]);
        bytes[end..].copy_from_slice(&crc.sum().to_le_bytes());
        fs::write(&path, &bytes).unwrap();
        let error = Checkpoint::read(&path).unwrap_err();
        assert!(
            matches!(error, CheckpointError::Malformed { .. }),
            "{error:?}"
        );
    }
}

#[test]
fn what_does_not_fit_is_named() {
    let checkpoint = sample();
    checkpoint.check_fingerprint(0xfeed_beef_0123_4567).unwrap();
    let error = checkpoint.check_fingerprint(1).unwrap_err();
    assert!(matches!(
        error,
        CheckpointError::OtherScene { expected: 1, .. }
    ));
    assert!(error.to_string().starts_with("checkpoint of another scene"));
    let missing = checkpoint.values::<f64>("velocity").unwrap_err();
    assert_eq!(
        missing.to_string(),
        "the checkpoint has no section 'velocity'"
    );
    let kind = checkpoint.values::<u64>("position").unwrap_err();
    assert_eq!(
        kind.to_string(),
        "section 'position' of the checkpoint holds f64, expected u64"
    );
    let length = checkpoint.array::<f64>("position", 6).unwrap_err();
    assert_eq!(
        length.to_string(),
        "section 'position' of the checkpoint has 5 values, expected 6"
    );
}

#[test]
fn a_repeated_section_is_refused_and_the_old_checkpoint_stays() {
    let (_folder, path, bytes) = written();
    let mut twice = sample();
    twice.push("step", vec![1_u64]);
    assert!(
        matches!(twice.write(&path), Err(CheckpointError::RepeatedSection { name }) if name == "step")
    );
    assert_eq!(fs::read(&path).unwrap(), bytes);
}
