//! Demands on published packages: every package says what it is and under which licence, brings its
//! licences and a page to read, and what users build by hand stays buildable.

use std::process::Command;

use serde_json::Value;

fn cargo(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    assert!(
        output.status.success(),
        "cargo {arguments:?}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("cargo writes text")
}

/// The packages of the workspace that can be published.
fn packages() -> Vec<Value> {
    let metadata: Value = serde_json::from_str(&cargo(&[
        "metadata",
        "--no-deps",
        "--offline",
        "--format-version",
        "1",
    ]))
    .unwrap();
    let all = metadata["packages"].as_array().unwrap().clone();
    all.into_iter()
        .filter(|package| {
            package["publish"].as_array().is_none_or(|registries| !registries.is_empty())
        })
        .collect()
}

#[test]
fn every_package_has_its_licences_and_a_readme() {
    let packages = packages();
    assert!(packages.len() >= 4, "{packages:?}");
    for package in &packages {
        let name = package["name"].as_str().unwrap();
        for key in ["description", "license", "readme", "rust_version"] {
            assert!(
                package[key].as_str().is_some_and(|text| !text.is_empty()),
                "{name} has no {key}"
            );
        }
        assert_eq!(package["license"], packages[0]["license"], "{name}");
        // No address is better than a wrong one: the field is absent until the repository is
        // public.
        let repository = package["repository"].as_str().unwrap_or_default();
        assert!(!repository.contains("example."), "{name} names a placeholder: {repository}");
        assert_eq!(package["repository"], packages[0]["repository"], "{name}");
        let files = cargo(&["package", "--list", "--allow-dirty", "--offline", "-p", name]);
        for file in ["LICENSE-MIT", "LICENSE-APACHE", "README.md", "Cargo.toml"] {
            assert!(
                files.lines().any(|line| line == file),
                "{name} is packed without {file}:\n{files}"
            );
        }
    }
}

#[test]
fn options_are_written_with_what_differs_from_the_default() {
    let options = kin::SolverOptions::new().jerk(true);
    assert!(options.jerk);
    let _ = kin::solver::AssemblyOptions::new();
    let _ = kin::solver::SearchOptions::new();
}

#[test]
fn limits_can_be_named_as_data() -> kin::Result<()> {
    use kin::prelude::*;
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.0, 0.0, 0.0))?;
    m.add(
        "guide",
        prismatic(slider, m.ground(), vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(1.0, 0.0), 0.0),
    )?;
    m.limit("guide.slide", -1.0, 2.0)?;
    let limits: Vec<kin::data::LimitData> = m.data()?.limits;
    assert_eq!(limits[0].measure, "guide.slide");
    Ok(())
}
