//! Axes: their ticks and labels.

use proctor_benchmark::show::chart::{Axis, Format, Scale};

fn texts(scale: Scale, format: Format, values: &[f64]) -> (Vec<String>, String) {
    let axis = Axis {
        label: "q".to_owned(),
        scale,
        format,
    };
    let ranged = axis.ranged(values.iter().copied(), false);
    for value in values.iter().filter(|v| v.is_finite()) {
        let share = ranged.share(*value).expect("a place");
        assert!((0.0..=1.0).contains(&share), "{value} at {share}");
    }
    let ticks = ranged.ticks.into_iter().map(|t| t.text).collect();
    (ticks, ranged.label)
}

#[test]
fn decades_of_errors_and_times() {
    let (errors, _) = texts(Scale::Log, Format::Percent, &[2e-4, 0.3]);
    assert_eq!(errors, ["0.1 %", "1 %", "10 %"]);
    let (times, _) = texts(Scale::Log, Format::Seconds, &[2e-4, 30.0]);
    assert_eq!(times, ["0.1 ms", "1 ms", "10 ms", "0.1 s", "1 s", "10 s"]);
    let (cells, _) = texts(Scale::Log, Format::Number, &[0.016, 0.125]);
    assert_eq!(cells, ["0.02", "0.05", "0.1"]);
    let (small, _) = texts(Scale::Log, Format::Number, &[2e-9, 5e-6]);
    assert_eq!(small, ["10⁻⁸", "10⁻⁷", "10⁻⁶"]);
}

#[test]
fn linear_ticks_are_round_and_leave_out_powers_of_ten() {
    assert_eq!(
        texts(Scale::Linear, Format::Number, &[0.02, 0.98]).0,
        ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]
    );
    let (ticks, label) = texts(Scale::Linear, Format::Number, &[-3.1e-8, 0.0]);
    assert_eq!(ticks, ["-40", "-30", "-20", "-10", "0"]);
    assert_eq!(label, "q / 10⁻⁹");
}

#[test]
fn nothing_to_show_and_one_value_have_a_range() {
    for values in [&[][..], &[3.0], &[f64::NAN]] {
        for scale in [Scale::Linear, Scale::Log] {
            texts(scale, Format::Number, values);
        }
    }
}
