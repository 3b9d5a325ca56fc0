//! Place of a path in a JSON text.

use proctor_files::json::position::{find, location};

const TEXT: &str = "{\n  \"a\": {\"é\": 1, \"b.c\": [10, {\"d\": \"x\\\"}\"}]},\n  \"a2\": true\n}";

fn shown(path: &str) -> (&str, usize, usize, bool) {
    let place = find(TEXT, path).expect("JSON");
    let at = location("f", TEXT, place.key);
    (
        &TEXT[place.value..place.end],
        at.line,
        at.column,
        place.exact,
    )
}

#[test]
fn paths_are_found() {
    assert_eq!(shown("a.é"), ("1", 2, 9, true));
    assert_eq!(shown("a.b.c[0]"), ("10", 2, 25, true));
    assert_eq!(shown("a.b.c[1].d"), ("\"x\\\"}\"", 2, 30, true));
    assert_eq!(shown("a2"), ("true", 3, 3, true));
}

#[test]
fn a_missing_path_gives_what_encloses_it() {
    assert_eq!(shown("a.b.c[1].e"), ("{\"d\": \"x\\\"}\"}", 2, 29, false));
    assert_eq!(shown("a.é.x"), ("1", 2, 9, false));
    assert_eq!(shown("zzz"), (TEXT, 1, 1, false));
}

#[test]
fn the_last_of_equal_keys_is_found() {
    let text = r#"{"a": 1, "a": 2}"#;
    assert_eq!(find(text, "a").map(|p| p.key), Some(9));
}

#[test]
fn text_that_stops_being_json_gives_what_was_read() {
    let text = r#"{"a": [1, "#;
    assert_eq!(find(text, "a[0]").map(|p| (p.value, p.end)), Some((7, 8)));
    assert_eq!(find("", "a"), None);
    assert!(find(&"[".repeat(1_000_000), "").is_some());
}
