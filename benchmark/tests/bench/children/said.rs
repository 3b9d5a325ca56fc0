//! The end of the output of a process, for the message of its failure.

use proctor_benchmark::bench::children::said::with_words;

#[test]
fn colours_are_left_out_and_errors_come_before_the_last_lines() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let [errors, output] =
        ["standard-error.txt", "standard-output.txt"].map(|name| folder.path().join(name));
    let told = |text: &str| {
        std::fs::write(&errors, text).expect("written");
        with_words("it failed", folder.path())
    };
    assert_eq!(
        told("\u{1b}[1;31merror\u{1b}[0m: no\u{7} cell"),
        "it failed; on standard error: error: no cell"
    );
    let mut text = String::from("Error: the mesh is empty\n");
    text.extend((0..20).map(|i| format!("cleaning up {i}\n")));
    assert_eq!(
        told(&text),
        "it failed; on standard error: Error: the mesh is empty"
    );
    // Without an error the last four lines.
    let last: Vec<String> = (16..20).map(|i| format!("cleaning up {i}")).collect();
    assert_eq!(
        told(&text.replace("Error", "Note")),
        format!("it failed; on standard error: {}", last.join(" / "))
    );
    // The rest of the output has nothing to do with the error.
    std::fs::write(&output, "Devices: one\n").expect("written");
    let error = "error: no contact";
    assert_eq!(
        told(error),
        format!("it failed; on standard error: {error}")
    );
    assert_eq!(
        told("done"),
        "it failed; on standard error: done; on standard output: Devices: one"
    );
}
