//! A case on a terminal.

use proctor_benchmark::show::case::in_two;

#[test]
fn long_names_break_near_their_middle() {
    assert_eq!(in_two("u_z at (.5,.5,.5)"), ("u_z at", "(.5,.5,.5)"));
    assert_eq!(in_two("v(H, t)"), ("", "v(H, t)"));
}
