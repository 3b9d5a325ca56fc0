//! Soil that parts carries nothing until its volume is back.

use crate::laws::support::{DENSITY, close, numbers, point};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_laws::{
    AnyLaw, ConeMatch, DruckerPrager, GAP, LinearElastic, MohrCoulomb, Particle, Point, Softening,
    Tresca, UNDEFORMED,
};

const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.25;
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));

/// Laws of a friction, cohesion and dilation.
fn soils(friction: f64, cohesion: f64, dilation: f64) -> Vec<AnyLaw> {
    let cone = [friction, cohesion, dilation];
    let of = |matched| DruckerPrager::new(YOUNG, POISSON, cone, matched).into();
    vec![
        MohrCoulomb::new(YOUNG, POISSON, cone).into(),
        of(ConeMatch::PlaneStrain),
        of(ConeMatch::Outer),
        of(ConeMatch::Inner),
    ]
}

/// Takes a point through strains, each in 50 steps.
fn walk(point: &mut Point, parts: &[[f64; 6]]) {
    for part in parts {
        for _ in 0..50 {
            point
                .strain(&part.map(|e| e / 50.0), 1.0)
                .expect("a finite stress");
        }
    }
}

fn largest(stress: [f64; 6]) -> f64 {
    stress.iter().fold(0.0, |most, s| most.max(s.abs()))
}

fn gap(point: &Point, law: &AnyLaw) -> f64 {
    let place = law.variables().iter().position(|v| *v == GAP);
    point.variables()[place.expect("the law parts")]
}

const fn all(e: f64) -> [f64; 6] {
    [e, e, e, 0.0, 0.0, 0.0]
}

/// Sand that was drawn apart by 3 % bears no stress on the way back to its volume, and from there on the pressure of what it
/// is compressed by.
#[test]
fn sand_bears_nothing_until_its_volume_is_back() {
    for (friction, dilation) in [(30.0, 0.0), (38.0, 12.0), (25.0, -5.0), (33.0, 33.0)] {
        for law in soils(friction, 0.0, dilation) {
            let mut point = point(&law);
            walk(&mut point, &[all(0.01)]);
            close(gap(&point, &law), 0.03, 1e-12, 1.0);
            for _ in 0..3 {
                walk(&mut point, &[all(-0.01 / 3.0)]);
                assert!(
                    largest(point.stress()) < 1e-9,
                    "{law:?} {:?}",
                    point.stress()
                );
            }
            walk(&mut point, &[all(-0.002)]);
            for s in &point.stress()[..3] {
                close(*s, -BULK * 0.006, 1e-9, BULK * 0.006);
            }
            assert!(point.dissipated().abs() < 1e-12 && gap(&point, &law).abs() < 1e-15);
        }
    }
}

/// Whatever way it went meanwhile: opened along one axis and closed along another, sheared, turned.
#[test]
fn the_way_of_what_is_afloat_does_not_matter() {
    for dilation in [0.0, 15.0] {
        for law in soils(30.0, 0.0, dilation) {
            let mut point = point(&law);
            // What first opens it from all sides is a gap alone, whatever the dilation.
            walk(&mut point, &[all(1e-5)]);
            walk(&mut point, &[[0.0, 0.05 - 3e-5, 0.0, 0.0, 0.0, 0.0]]);
            walk(&mut point, &[[0.02, 0.0, 0.01, 0.3, -0.2, 0.4]]);
            walk(&mut point, &[[-0.04, 0.0, -0.039, 0.0, 0.1, 0.0]]);
            assert!(
                largest(point.stress()) < 1e-9,
                "{law:?} {:?}",
                point.stress()
            );
            close(gap(&point, &law), 0.001, 1e-12, 0.08);
            // The gap closes in the middle of a step.
            point.strain(&all(-0.001), 1.0).expect("a finite stress");
            for s in &point.stress()[..3] {
                close(*s, -BULK * 0.002, 1e-9, BULK * 0.002);
            }
        }
    }
}

/// Dilation in shear under pressure is no gap: what it added to the volume is not taken back without pressure.
#[test]
fn dilation_opens_no_gap() {
    for law in soils(30.0, 0.0, 10.0) {
        let mut point = Point::new(&law, DENSITY, [-2e4, -2e4, -2e4, 0.0, 0.0, 0.0]);
        let swelling = [2e-3, 2e-3, 0.0, 0.0, 0.0, 0.0];
        for _ in 0..400 {
            // The volume grows as flow does, so that pressure neither falls to nothing nor grows much.
            let share = 1.0 / 400.0;
            let mut step = swelling.map(|e| e * share);
            step[5] = 0.05 * share;
            point.strain(&step, 1.0).expect("a finite stress");
            assert_eq!(gap(&point, &law), 0.0, "{law:?}");
        }
        let before = point.stress();
        let pressure = -(before[0] + before[1] + before[2]) / 3.0;
        assert!(pressure > 1e3, "{law:?}: {pressure}");
        walk(&mut point, &[all(-1e-3)]);
        let after = point.stress();
        let more = -(after[0] + after[1] + after[2]) / 3.0 - pressure;
        assert!(more > 0.99 * BULK * 3e-3, "{law:?}: {more}");
    }
}

/// A soil with cohesion is drawn apart at its tension, and its gap closes at no pressure: neither is work given back, nor has
/// what is afloat a shear stress.
#[test]
fn a_gap_of_a_cohesive_soil_closes_at_no_pressure() {
    let cut = |law: MohrCoulomb| -> AnyLaw { law.with_tensile(2e3).into() };
    let mut laws = soils(30.0, 5e3, 10.0);
    laws.push(cut(MohrCoulomb::new(YOUNG, POISSON, [30.0, 5e3, 10.0])));
    laws.push(
        DruckerPrager::new(YOUNG, POISSON, [30.0, 5e3, 0.0], ConeMatch::Outer)
            .with_tensile(2e3)
            .into(),
    );
    laws.push(Tresca::new(YOUNG, POISSON, 5e3).with_tensile(2e3).into());
    for (i, law) in laws.iter().enumerate() {
        let tension = if i < 4 {
            5e3 / libm::tan(30_f64.to_radians())
        } else {
            2e3
        };
        let mut point = point(law);
        walk(&mut point, &[all(0.02)]);
        for s in &point.stress()[..3] {
            close(*s, tension, 1e-9, tension);
        }
        let opened = 0.06 - tension / BULK;
        close(gap(&point, law), opened, 1e-9, 1.0);
        let work = point.dissipated();
        // The stress works on the present volume, the work is told per initial one.
        close(work, tension * opened, 0.07, tension * opened);
        // The disc that cuts a cone off has a shear strength, which a change of shape would call.
        let closing = if i == 5 {
            all(-0.058 / 3.0)
        } else {
            [0.0, 0.0, -0.058, 0.0, 0.0, 0.0]
        };
        walk(&mut point, &[closing]);
        assert!(
            largest(point.stress()) < 1e-9,
            "{law:?} {:?}",
            point.stress()
        );
        close(point.dissipated(), work, 1e-12, work);
        walk(&mut point, &[all(-0.002 / 3.0), all(-0.001)]);
        for s in &point.stress()[..3] {
            close(*s, -BULK * 0.003, 1e-9, BULK * 0.003);
        }
        close(point.dissipated(), work, 1e-12, work);
    }
}

/// a : b of symmetric tensors.
fn double(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let weight = |i| if i < 3 { 1.0 } else { 2.0 };
    (0..6).map(|i| weight(i) * a[i] * b[i]).sum()
}

/// Also while gaps open and close the trapezoidal work of a step is stored, plastic or algorithmic, and nothing is dissipated
/// backwards.
#[test]
fn work_goes_where_it_is_told_to_go() {
    let elastic = LinearElastic::new(YOUNG, POISSON);
    let mut laws = soils(30.0, 0.0, 10.0);
    laws.extend(soils(30.0, 2e3, 0.0));
    let cut = MohrCoulomb::new(YOUNG, POISSON, [30.0, 5e3, 10.0]).with_tensile(2e3);
    laws.push(cut.into());
    laws.push(cut.relaxing(0.7).into());
    let cut = DruckerPrager::new(YOUNG, POISSON, [30.0, 5e3, 5.0], ConeMatch::Outer);
    laws.push(cut.with_tensile(2e3).into());
    for law in laws {
        let mut next = numbers(11);
        let mut point = self::point(&law);
        let (mut open, mut closed) = (0, 0);
        for k in 0..2000 {
            if k % 20 == 0 {
                // Dilation would hold it under pressure for good.
                point = self::point(&law);
            }
            // It swells and shrinks more than it is sheared, and its volume comes back.
            let swelling = 1e-2 * next() - 0.1 * point.volume().ln();
            let step: [f64; 6] =
                std::array::from_fn(|i| 2e-3 * next() + if i < 3 { swelling } else { 0.0 });
            let (before, was) = (point.clone(), gap(&point, &law));
            point.strain(&step, 1.0).expect("a finite stress");
            let (start, after) = (before.stress(), point.stress());
            let middle: [f64; 6] = std::array::from_fn(|i| 0.5 * (start[i] + after[i]));
            let work = double(&middle, &step);
            let stored = [start, after].map(|s| elastic.energy_density(&s));
            let plastic = (point.dissipated() - before.dissipated()) / point.volume();
            let other = (point.algorithmic() - before.algorithmic()) / point.volume();
            let sum = stored[1] - stored[0] + plastic + other;
            // Sums of all steps lose digits, and so does a trial stress that is returned.
            let scale = stored[0] + stored[1] + plastic.abs() + other.abs() + point.dissipated();
            let trial = YOUNG * largest(step) * largest(step);
            assert!(
                (sum - work).abs() <= 1e-13 * (scale + trial),
                "{law:?}: {work} {sum}"
            );
            assert!(plastic >= -1e-13 * (scale + trial), "{law:?}: {plastic}");
            let now = gap(&point, &law);
            assert!(now >= 0.0);
            open += i32::from(was == 0.0 && now > 0.0);
            closed += i32::from(was > 0.0 && now == 0.0);
        }
        assert!(open > 10 && closed > 10, "{law:?}: {open} {closed}");
    }
}

/// A point that is afloat is as fast as one at rest, however large it is, and moves no gap by being asked again.
#[test]
fn what_is_afloat_is_no_faster_than_at_rest() {
    for law in soils(30.0, 0.0, 0.0) {
        let mut point = point(&law);
        walk(&mut point, &[all(0.4)]);
        assert!(point.volume() > 3.0);
        let before = gap(&point, &law);
        point.step(&[[0.0; 3]; 3], 1.0).expect("a finite stress");
        assert_eq!(gap(&point, &law).to_bits(), before.to_bits());
        let square = law.speed_squared(&Particle {
            mass: DENSITY,
            volume: point.volume(),
            density: DENSITY,
            stress: point.stress(),
            deformation: UNDEFORMED,
            variables: &point.variables(),
        });
        let at_rest = law.wave_speed(DENSITY).powi(2);
        close(square, at_rest, 1e-14, at_rest);
    }
}

/// Paths on which gaps open and close have the same bits on all lanes, whatever their neighbours do.
#[test]
fn all_lanes_have_the_same_bits() {
    let lanes = [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar];
    let lanes: Vec<SelectedLanes> = lanes
        .into_iter()
        .filter_map(|choice| SelectedLanes::new(choice).ok())
        .chain([SelectedLanes::plain()])
        .collect();
    let softens = MohrCoulomb::new(YOUNG, POISSON, [30.0, 1e3, 10.0]).softening(
        Softening::Exponential { eta: 3.0 },
        proctor_laws::Residual {
            cohesion: Some(0.0),
            ..Default::default()
        },
    );
    let mut laws = soils(30.0, 0.0, 10.0);
    laws.push(softens.into());
    for law in laws {
        let mut found: Vec<Vec<u64>> = vec![];
        for lanes in &lanes {
            let mut next = numbers(3);
            let mut point = point(&law).on(*lanes);
            for _ in 0..500 {
                let step: [f64; 6] = std::array::from_fn(|_| 4e-3 * next());
                point.strain(&step, 1.0).expect("a finite stress");
            }
            let state = point.stress().into_iter().chain(point.variables());
            found.push(state.map(f64::to_bits).collect());
        }
        assert!(found.windows(2).all(|pair| pair[0] == pair[1]), "{law:?}");
    }
}
