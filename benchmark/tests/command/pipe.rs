//! A reader that goes away is no failure.

use crate::support::{command, fixture};
use std::io::Read;
use std::process::Stdio;

#[test]
fn a_closed_pipe_is_no_failure() {
    let scene = fixture("fixtures/scenes/manual/boussinesq.json");
    for arguments in [vec!["schema"], vec!["plan", &scene], vec!["run", &scene]] {
        let mut child = command(&arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        // Closed before anything is read.
        drop(child.stdout.take());
        let mut complaint = String::new();
        let stderr = child.stderr.as_mut().expect("piped");
        stderr.read_to_string(&mut complaint).expect("text");
        assert_eq!(child.wait().expect("ends").code(), Some(0), "{arguments:?}");
        assert_eq!(complaint, "", "{arguments:?}");
    }
}
