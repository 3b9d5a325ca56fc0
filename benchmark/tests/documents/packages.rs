//! The packages of the workspace: each has a licence, and names the version of each of the others that it needs.

use super::root;
use serde_json::Value;
use std::process::Command;

#[test]
fn each_package_has_a_licence_and_versions_of_what_it_needs() {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--no-deps",
            "--offline",
            "--format-version",
            "1",
        ])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let packages = metadata["packages"].as_array().expect("packages");
    assert_eq!(packages.len(), 11);
    // `cargo run` takes the one program of the default members.
    let members = metadata["workspace_default_members"].as_array();
    let members = members.expect("default members");
    let default = packages
        .iter()
        .filter(|package| members.contains(&package["id"]));
    let targets = default.flat_map(|package| package["targets"].as_array().expect("targets"));
    let programs: Vec<&Value> = targets
        .filter(|target| target["kind"] == serde_json::json!(["bin"]))
        .map(|target| &target["name"])
        .collect();
    assert_eq!(programs, ["proctor"]);
    for package in packages {
        let name = &package["name"];
        assert_eq!(package["license"], "MIT OR Apache-2.0", "{name}");
        let needed = package["dependencies"].as_array().expect("dependencies");
        for needed in needed {
            // Tests may depend on packages that are not published yet: cargo leaves these out of a package.
            let is_own = needed["path"].is_string() && needed["kind"] != "dev";
            assert!(
                !is_own || needed["req"] != "*",
                "{name}: {}",
                needed["name"]
            );
        }
    }
}
