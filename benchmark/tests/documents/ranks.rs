//! The page of ranks names each part of a scene that they refuse, and nothing else.

use super::text_of;
use proctor_kernel::simulation::NOT_LOCAL;

#[test]
fn the_page_of_ranks_names_what_they_refuse() {
    let page = text_of("docs/src/howto/ranks.md").replace('\n', " ");
    let (_, limits) = page.split_once("Refused by name: ").expect("a sentence");
    let (sentence, _) = limits
        .split_once(", unless they are local (`Condition::not_local`, `Interaction::not_local`).")
        .expect("its end");
    let (named, _) = sentence
        .split_once(", and its own interactions")
        .expect("the rest");
    let mut named: Vec<&str> = named.split(", ").collect();
    named.sort_unstable();
    let mut refused: Vec<&str> = proctor_contact::NOT_LOCAL
        .into_iter()
        .chain(NOT_LOCAL)
        .collect();
    refused.sort_unstable();
    assert_eq!(named, refused);
}
