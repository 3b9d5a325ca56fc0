//! Drawings as pixels.

use proctor_benchmark::show::drawing::{
    Anchor, Drawing, INK, Item, PAPER, Pixels, Rgb, TextSize, animation, png,
};
use std::io::Cursor;

fn drawing() -> Drawing {
    let size = [60, 40];
    let mut pixels = Pixels::new(size);
    pixels.square([10.0, 10.0], 4.0, [200, 0, 0]);
    pixels.ball([40.0, 20.0], 8.0, [0, 0, 200]);
    // Beyond the edges nothing happens.
    pixels.square([-50.0, 500.0], 3.0, [0; 3]);
    pixels.ball([-50.0, 500.0], 3.0, [0; 3]);
    Drawing {
        size,
        title: "a test".to_owned(),
        behind: vec![],
        pixels,
        before: vec![
            Item::Line {
                from: [0.0, 30.5],
                to: [60.0, 30.5],
                colour: INK,
                width: 1.0,
            },
            Item::Text {
                text: "x".to_owned(),
                at: [50.0, 38.0],
                anchor: Anchor::Middle,
                size: TextSize::Plain,
            },
        ],
    }
}

#[test]
fn a_drawing_reads_back_pixel_by_pixel() {
    let file = png(&drawing());
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let mut values = vec![0; 60 * 40 * 3];
    let info = reader.next_frame(&mut values).unwrap();
    assert_eq!((info.width, info.height), (60, 40));
    let at = |x: usize, y: usize| -> Rgb { values[3 * (60 * y + x)..][..3].try_into().unwrap() };
    assert_eq!(at(10, 10), [200, 0, 0]);
    assert_eq!(at(2, 2), PAPER);
    assert_eq!(at(40, 20), [0, 0, 200]);
    // A ball is darker towards its edge.
    assert!(at(47, 20)[2] < 160);
    assert_eq!(at(5, 30), INK);
}

#[test]
fn an_animation_has_all_its_frames() {
    let file = animation(&[drawing(), drawing(), drawing()], 0.1);
    let reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let control = reader.info().animation_control.expect("an animation");
    assert_eq!(control.num_frames, 3);
}
