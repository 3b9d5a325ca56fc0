//! Curves and drawings: what a run computed beside what should be, for pictures.

/// Computed against exact along one coordinate, for pictures; or computed alone, where there is nothing exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Title: the quantity, and where.
    pub title: String,
    /// Name and unit of the coordinate.
    pub abscissa: &'static str,
    /// Name and unit of the quantity.
    pub ordinate: &'static str,
    /// Points in order of the coordinate. Where there are several lines, a point that is not a number parts them.
    pub points: Vec<CurvePoint>,
}

impl Curve {
    /// A curve by its title, the names and units of coordinate and quantity, and its points.
    #[must_use]
    pub fn new(
        title: String,
        [abscissa, ordinate]: [&'static str; 2],
        points: impl IntoIterator<Item = CurvePoint>,
    ) -> Self {
        Self {
            title,
            abscissa,
            ordinate,
            points: points.into_iter().collect(),
        }
    }

    /// True where any point has an exact value.
    #[must_use]
    pub fn has_exact(&self) -> bool {
        self.points.iter().any(|p| p.exact.is_finite())
    }
}

/// A point of a [`Curve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The coordinate.
    pub at: f64,
    /// Value as computed.
    pub computed: f64,
    /// Value as it should be. A curve that has it nowhere is shown alone.
    pub exact: f64,
}

impl CurvePoint {
    /// A point by its coordinate, what was computed there and what it should be.
    #[must_use]
    pub const fn new(at: f64, computed: f64, exact: f64) -> Self {
        Self {
            at,
            computed,
            exact,
        }
    }

    /// Puts points in order and keeps one of those that lie within `width` of each other: particles of one layer of a
    /// problem in one dimension.
    pub fn one_per_place(points: &mut Vec<Self>, width: f64) {
        points.sort_by(|p, q| p.at.total_cmp(&q.at));
        points.dedup_by(|p, q| (p.at - q.at).abs() < width);
    }
}

/// Places of the bodies at one time of a run in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Title: the bodies, and the time.
    pub title: String,
    /// Outlines of the bodies, closed \[m\].
    pub bodies: Vec<Vec<[f64; 2]>>,
    /// Rigid lines, open \[m\].
    pub lines: Vec<Vec<[f64; 2]>>,
}
