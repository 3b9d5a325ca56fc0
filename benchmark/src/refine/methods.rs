//! Ladders of several methods side by side: which one is cheapest, and whether all of them have one limit.

use super::judge::SceneBars;
use super::work::Runs;
use proctor_scene::{DomainUpdate, Scene, StressScheme, Transfer, TransferKind, Weighting};
use proctor_verification::settings::Method;

/// Least share of the quantities that have a bar, for a method to be named the cheapest.
const LEAST_SHARE: f64 = 0.5;

/// A scene refined with a method.
pub struct MethodRun {
    /// The method.
    pub method: Method,
    /// Its runs.
    pub runs: Runs,
    /// Their judgement, or the reason why there is none.
    pub refined: Result<SceneBars, String>,
}

/// The method of a scene.
#[must_use]
pub fn of(scene: &Scene) -> Method {
    Method {
        weighting: scene.weighting,
        scheme: scene.scheme,
        transfer: scene.transfer.kind,
    }
}

/// The scene with another method.
#[must_use]
pub fn with(scene: &Scene, method: Method) -> Scene {
    let mut scene = scene.clone();
    if word(method) != word(of(&scene)) {
        scene.weighting = method.weighting;
        scene.scheme = method.scheme;
        scene.transfer = Transfer::new(method.transfer);
    }
    scene
}

/// The name of a method in one word, as in `cpGIMP-MUSL-FLIP`.
#[must_use]
pub fn word(method: Method) -> String {
    method.to_string().replace(' ', "-")
}

/// The methods that are tried where the user names none: the scene's own, and those that are cheapest most often where
/// answers are known.
#[must_use]
pub fn usual(scene: &Scene) -> Vec<Method> {
    let contiguous = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let mut all = vec![of(scene)];
    for (weighting, scheme, transfer) in [
        (contiguous, StressScheme::Musl, TransferKind::Flip),
        (
            Weighting::QuadraticBSpline,
            StressScheme::Musl,
            TransferKind::Apic,
        ),
        (
            Weighting::UniformGimp,
            StressScheme::Usl,
            TransferKind::Apic,
        ),
    ] {
        let method = Method {
            weighting,
            scheme,
            transfer,
        };
        if all.iter().all(|known| word(*known) != word(method)) {
            all.push(method);
        }
    }
    all
}

/// The method of a word such as `cpGIMP-MUSL-FLIP`, in letters of any case.
#[must_use]
pub fn named(text: &str) -> Option<Method> {
    every()
        .into_iter()
        .find(|method| word(*method).eq_ignore_ascii_case(text))
}

/// Every method.
#[must_use]
pub fn every() -> Vec<Method> {
    let weightings = [
        Weighting::Linear,
        Weighting::UniformGimp,
        Weighting::ContiguousGimp(DomainUpdate::Stretch),
        Weighting::ContiguousGimp(DomainUpdate::Determinant),
        Weighting::ContiguousGimp(DomainUpdate::LeftStretch),
        Weighting::QuadraticBSpline,
    ];
    let schemes = [StressScheme::Usf, StressScheme::Usl, StressScheme::Musl];
    let transfers = [TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic];
    let of = |weighting| {
        schemes.into_iter().flat_map(move |scheme| {
            transfers.into_iter().map(move |transfer| Method {
                weighting,
                scheme,
                transfer,
            })
        })
    };
    weightings.into_iter().flat_map(of).collect()
}

impl MethodRun {
    /// Time for an error of 1 % of the change, in the median over the quantities \[s\]; `None` where the scene does not settle
    /// or fewer than half of the quantities have a bar.
    #[must_use]
    pub fn seconds_for_one_percent(&self) -> Option<f64> {
        let refined = self.refined.as_ref().ok()?;
        let exponent = self.runs.exponent();
        let finest = self.runs.finest_seconds();
        let mut times: Vec<f64> = (refined.judged.iter())
            .filter_map(|judged| judged.cell_for_one_percent(refined.cells[2]))
            .map(|cell| finest * libm::pow(refined.cells[2] / cell, exponent))
            .collect();
        times.sort_by(f64::total_cmp);
        let enough = times.len() as f64 >= LEAST_SHARE * refined.judged.len() as f64;
        let middle = times.get(times.len() / 2).copied();
        middle.filter(|_| enough && refined.until().is_none())
    }
}

/// The method with the least time for an error of 1 %.
#[must_use]
pub fn cheapest(all: &[MethodRun]) -> Option<(&MethodRun, f64)> {
    let times = all
        .iter()
        .filter_map(|run| Some((run, run.seconds_for_one_percent()?)));
    times.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// A quantity whose bars of two methods do not overlap: its name, and method, value and half-width of each.
pub type Apart = (String, [(Method, f64, f64); 2]);

/// Every quantity whose bars of two methods do not overlap: one of them is wrong, for they have one limit.
#[must_use]
pub fn apart(all: &[MethodRun]) -> Vec<Apart> {
    let mut apart = vec![];
    for (k, first) in all.iter().enumerate() {
        for second in &all[k + 1..] {
            let (Ok(a), Ok(b)) = (&first.refined, &second.refined) else {
                continue;
            };
            for one in &a.judged {
                let same = |other: &&super::judge::QuantityBar| other.quantity == one.quantity;
                let Some(other) = b.judged.iter().find(same) else {
                    continue;
                };
                if let (Some(u), Some(v)) = (one.bar(), other.bar())
                    && (one.value() - other.value()).abs() > u + v
                {
                    apart.push((
                        one.quantity.name.clone(),
                        [
                            (first.method, one.value(), u),
                            (second.method, other.value(), v),
                        ],
                    ));
                }
            }
        }
    }
    apart
}
