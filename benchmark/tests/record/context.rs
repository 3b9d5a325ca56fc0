//! The context says where and how it was measured.

use proctor_benchmark::record::context;
use proctor_scene::simulation::Options;
use std::time::{Duration, UNIX_EPOCH};

#[test]
fn a_context_names_build_and_machine_but_no_host_and_no_user() {
    let context = context::now(&Options::default());
    for key in [
        "schema_version",
        "date",
        "num_cpus",
        "rustc",
        "library_build_type",
        "target",
        "target_features_compiled",
        "target_features_detected",
        "features",
        "lanes",
    ] {
        assert!(!context[key].is_null(), "{key} is missing");
    }
    let rustc = context["rustc"].as_str().expect("a word");
    assert!(rustc.starts_with("rustc 1."), "{rustc}");
    assert!(context.get("host_name").is_none());
    assert!(context.get("user").is_none());
}

#[cfg(target_os = "linux")]
#[test]
fn caches_have_the_shape_of_google_benchmark() {
    let context = context::now(&Options::default());
    let Some(caches) = context.get("caches") else {
        return; // a machine that tells nothing of its caches
    };
    for cache in caches.as_array().expect("a list") {
        assert!(cache["type"].is_string());
        for key in ["level", "size", "num_sharing"] {
            assert!(cache[key].as_u64().is_some_and(|n| n > 0), "{key}: {cache}");
        }
    }
    assert_eq!(context["load_avg"].as_array().map(Vec::len), Some(3));
}

#[test]
fn dates_are_those_of_the_calendar() {
    let at = |seconds| context::date(UNIX_EPOCH + Duration::from_secs(seconds));
    assert_eq!(at(0), "1970-01-01T00:00:00+00:00");
    assert_eq!(at(951_782_400), "2000-02-29T00:00:00+00:00");
    assert_eq!(at(1_735_689_599), "2024-12-31T23:59:59+00:00");
}
