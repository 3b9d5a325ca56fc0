//! Methods by their words.

use proctor_benchmark::refine::methods::{every, named, word};

#[test]
fn methods_are_named_by_their_words() {
    for method in every() {
        assert_eq!(named(&word(method)), Some(method));
    }
    assert_eq!(
        named("cpgimp-musl-flip").map(word),
        Some("cpGIMP-MUSL-FLIP".to_owned())
    );
    assert_eq!(named("cpGIMP MUSL"), None);
}
