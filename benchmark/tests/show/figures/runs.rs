//! Charts of the histories of runs.

use proctor_benchmark::runs::RunHistory;
use proctor_benchmark::show::figures::runs::histories;

#[test]
fn columns_that_belong_together_share_a_chart() {
    let names = [
        "step",
        "kinetic_energy",
        "strain_energy",
        "momentum_x",
        "body1_mass",
        "body1_x",
        "body1_y",
        "body1_vx",
        "body1_contact_fx",
        "tip_ux",
        "tip_uy",
        "tip_sxy",
        "worst_displacement",
        "worst_particle",
        "nothing_ux",
        "energy_friction",
        "body1_energy_stored",
    ];
    let history = RunHistory {
        times: vec![0.0, 1.0],
        columns: names
            .iter()
            .map(|name| {
                let value = if name.starts_with("nothing") {
                    0.0
                } else {
                    1.0
                };
                ((*name).to_owned(), vec![value; 2])
            })
            .collect(),
    };
    let charts = histories(&[("a".to_owned(), &history), ("b".to_owned(), &history)]);
    let titles: Vec<&str> = charts.iter().map(|chart| chart.title.as_str()).collect();
    assert_eq!(
        titles,
        [
            "tip: displacement",
            "body1: motion of the centre",
            "tip: stress",
            "body1: velocity",
            "worst_displacement",
            "body1: contact force",
            "Energy",
            "body1: energy",
            "Momentum"
        ]
    );
    assert_eq!(charts[0].y.label, "displacement (m)");
    // Two columns of two runs, and a line of the legend for each column and each run.
    assert_eq!((charts[0].series.len(), charts[0].legend.len()), (4, 4));
    assert_eq!(charts[1].series[0].points[1].y, Some(0.0));
}

#[test]
fn of_many_points_the_extremes_stay() {
    let times: Vec<f64> = (0..50_000).map(f64::from).collect();
    let mut values = vec![0.0; 50_000];
    values[777] = 3.0;
    values[778] = -2.0;
    let history = RunHistory {
        times,
        columns: vec![("tip_ux".to_owned(), values)],
    };
    let charts = histories(&[("a".to_owned(), &history)]);
    let kept = &charts[0].series[0].points;
    assert!(kept.len() <= 1200);
    for value in [3.0, -2.0] {
        assert!(kept.iter().any(|point| point.y == Some(value)));
    }
}
