//! Letters of pictures.

use proctor_benchmark::show::drawing::letters::{MORE, TextSize, each_pixel, width};

#[test]
fn every_letter_has_ink_of_its_width() {
    let letters: String = (33..127)
        .map(|c: u8| char::from(c))
        .chain(MORE.chars())
        .collect();
    for size in [TextSize::Plain, TextSize::Title] {
        for letter in letters.chars() {
            let text = letter.to_string();
            let (mut most, mut ink) = (i64::MIN, 0_u64);
            each_pixel(&text, size, [0.0, 0.0], |[x, _], value| {
                most = most.max(x);
                ink += u64::from(value);
            });
            assert!(ink > 100, "{letter}");
            assert!(most as f64 <= width(&text, size) + 1.0, "{letter} {most}");
        }
    }
}

#[test]
fn a_letter_that_is_not_there_is_a_question_mark() {
    let ink = |letter: &str| {
        let mut all = vec![];
        each_pixel(letter, TextSize::Plain, [0.0, 0.0], |at, value| {
            all.push((at, value));
        });
        all
    };
    assert_eq!(ink("語"), ink("?"));
    assert_eq!(width("", TextSize::Plain), 0.0);
}
