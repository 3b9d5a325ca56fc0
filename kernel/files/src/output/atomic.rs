//! Files that are whole or not there, and the folder they go into.

use std::cell::Cell;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tempfile::NamedTempFile;

use super::OutputError;

/// Start of the name of every temporary; what stands between it and [`TEMPORARY_SUFFIX`] is random.
pub const TEMPORARY_PREFIX: &str = ".proctor-";
/// End of the name of every temporary.
pub const TEMPORARY_SUFFIX: &str = ".tmp";

/// One system call per mebibyte: frames and checkpoints are hundreds of megabytes, the default of 8 KiB is
/// made for small files.
pub(super) const BUFFER: usize = 1 << 20;

/// Writes the file `path` so that it is, at any moment, either what it was before or wholly what `fill` writes.
///
/// The bytes go to a temporary in the same folder (a rename across file systems is not atomic), are synced to the
/// disk, and only then take the name `path`. When anything fails the temporary is removed.
///
/// # Errors
/// [`OutputError::Write`] with what `fill` or the operating system reported.
pub fn write(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_with(path, fill).map_err(|source| OutputError::write(path, source))
}

fn write_with(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let folder = folder_of(path);
    let mut writer = BufWriter::with_capacity(BUFFER, temporary(folder)?);
    fill(&mut writer)?;
    let file = writer
        .into_inner()
        .map_err(io::IntoInnerError::into_error)?;
    persist(file, path, folder)
}

/// A file of a known length that several processes fill before it takes its name. It is removed unless it takes it.
pub(super) struct Temporary {
    file: NamedTempFile,
    folder: PathBuf,
}

impl Temporary {
    /// A file of so many bytes in the folder of `path`.
    pub(super) fn beside(path: &Path, length: u64) -> io::Result<Self> {
        let folder = folder_of(path);
        let file = temporary(folder)?;
        file.as_file().set_len(length)?;
        Ok(Self {
            file,
            folder: folder.to_path_buf(),
        })
    }

    /// Its name in the folder.
    pub(super) fn name(&self) -> String {
        let name = self.file.path().file_name();
        name.unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Writes the rest, and gives the file the name `path`.
    pub(super) fn finish(
        mut self,
        path: &Path,
        fill: impl FnOnce(&mut File) -> io::Result<()>,
    ) -> io::Result<()> {
        fill(self.file.as_file_mut())?;
        persist(self.file, path, &self.folder)
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Syncs a file that is whole, and gives it its name.
fn persist(file: NamedTempFile, path: &Path, folder: &Path) -> io::Result<()> {
    if waits() {
        count_wait();
        file.as_file().sync_all()?;
    }
    file.persist(path)?;
    if waits() {
        sync_folder(folder);
    }
    Ok(())
}

thread_local! {
    /// True while files of this thread wait for the disk, and how many times it has waited.
    static WAITING: Cell<(bool, u64)> = const { Cell::new((true, 0)) };
}

fn waits() -> bool {
    WAITING.get().0
}

fn count_wait() {
    let (waits, count) = WAITING.get();
    WAITING.set((waits, count + 1));
}

/// Number of times that this thread has waited for the disk, for a file or a folder.
#[must_use]
pub fn number_of_waits() -> u64 {
    WAITING.get().1
}

/// Does work whose files, in the folder `path`, take their names without waiting for the disk, and waits once at its end, for
/// the folder. Each file is whole for who reads it; only a loss of power may take it. For results that are read at once and
/// then thrown away: of 29 ms of work with 21 frames the waiting made 440 ms.
pub fn without_waiting<T>(path: &Path, work: impl FnOnce() -> T) -> T {
    let (before, count) = WAITING.get();
    WAITING.set((false, count));
    let done = work();
    WAITING.set((before, number_of_waits()));
    sync_folder(path);
    done
}

fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY_PREFIX).suffix(TEMPORARY_SUFFIX);
    // Temporaries are private (0600) by default and keep that when renamed; results are for others to read, so
    // leave the mode to the umask, as for any other file.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Makes the rename itself survive a loss of power. Best effort: the file is whole either way, and some file
/// systems refuse to sync a folder.
fn sync_folder(folder: &Path) {
    #[cfg(unix)]
    if let Ok(folder) = fs::File::open(folder) {
        count_wait();
        let _ = folder.sync_all();
    }
    #[cfg(not(unix))]
    let _ = folder;
}

/// A folder that was found writable.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    path: PathBuf,
    /// Lock that keeps other runs out as long as a copy of this is alive; the system lets go of it when the process ends,
    /// however it ends.
    _claim: Option<Arc<File>>,
}

impl OutputFolder {
    /// Makes the folder `path` with its parents where missing, and checks that a file can be written into it, so
    /// that a run does not fail at its first frame.
    ///
    /// Temporaries that a killed run left there are removed; nothing else is touched. Two runs at the same time
    /// into one folder would mix their files: who writes one asks for it with [`OutputFolder::claim`].
    ///
    /// # Errors
    /// [`OutputError::Folder`] if it cannot be made or is not a folder, [`OutputError::NotWritable`] if no file can
    /// be written into it.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        Self::made(path.into(), |_| Ok(None))
    }

    /// Claims the folder as [`OutputFolder::create`] makes it, for one run alone: nobody else can claim it as long as a copy of
    /// this is alive. Where the file system knows no locks nobody is kept out.
    ///
    /// # Errors
    /// As [`OutputFolder::create`], and [`OutputError::InUse`] if another run has claimed it.
    pub fn claim(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        Self::made(path.into(), |path| match lock(path) {
            Ok(claim) => Ok(Some(Arc::new(claim))),
            Err(TryLockError::WouldBlock) => Err(OutputError::InUse {
                path: path.to_path_buf(),
            }),
            Err(TryLockError::Error(_)) => Ok(None),
        })
    }

    fn made(
        path: PathBuf,
        claim: impl FnOnce(&Path) -> Result<Option<Arc<File>>, OutputError>,
    ) -> Result<Self, OutputError> {
        if let Err(source) = fs::create_dir_all(&path) {
            return Err(OutputError::Folder { path, source });
        }
        // Before anything in it is touched: temporaries may be those of a run that is still at work.
        let claim = claim(&path)?;
        match check_writable(&path) {
            Ok(()) => Ok(Self {
                path,
                _claim: claim,
            }),
            Err(source) => Err(OutputError::NotWritable { path, source }),
        }
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of the file `name` in the folder.
    #[must_use]
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }
}

/// Locks the folder itself, which leaves no file behind.
#[cfg(unix)]
fn lock(folder: &Path) -> Result<File, TryLockError> {
    let folder = File::open(folder).map_err(TryLockError::Error)?;
    folder.try_lock()?;
    Ok(folder)
}

/// Locks a file in the folder, where a folder cannot be opened.
#[cfg(not(unix))]
fn lock(folder: &Path) -> Result<File, TryLockError> {
    let file = File::create(folder.join(".proctor.lock")).map_err(TryLockError::Error)?;
    file.try_lock()?;
    Ok(file)
}

/// Permission bits do not tell (root, read-only mounts, full disks), so a file is written.
fn check_writable(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let ours = name.to_str().is_some_and(is_temporary);
        if ours && entry.file_type()?.is_file() {
            fs::remove_file(entry.path())?;
        }
    }
    let mut probe = temporary(folder)?;
    probe.write_all(b"proctor")?;
    probe.close()
}

/// True of the names that [`OutputFolder`] and [`fn@write`] give to files until they are whole.
#[must_use]
pub fn is_temporary(name: &str) -> bool {
    name.strip_prefix(TEMPORARY_PREFIX)
        .and_then(|rest| rest.strip_suffix(TEMPORARY_SUFFIX))
        .is_some_and(|random| {
            !random.is_empty() && random.bytes().all(|b| b.is_ascii_alphanumeric())
        })
}
