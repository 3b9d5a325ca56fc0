//! Bounds that a user gives.

use proctor_benchmark::precision::bounds::Bound;

#[test]
fn a_bound_is_a_case_and_a_share() {
    let bound = |text: &str| text.parse::<Bound>().map(|bound| (bound.case, bound.error));
    assert_eq!(
        bound("self-weight=2%"),
        Ok(("self-weight".to_owned(), 0.02))
    );
    assert_eq!(bound("bar=0.5"), Ok(("bar".to_owned(), 0.5)));
    for text in [
        "bar",
        "bar=",
        "=2%",
        "bar=-1%",
        "bar=0",
        "bar=NaN",
        "bar=inf%",
        "bar=2 percent",
    ] {
        let fault = bound(text).expect_err(text);
        assert!(fault.contains("such as self-weight=2%"), "{fault}");
    }
}
