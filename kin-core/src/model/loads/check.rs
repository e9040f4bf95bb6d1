//! Checks that a mass and an inertia are physically possible.

use super::Solid;

/// The relative error that an inertia may have: entries across the diagonal may differ by this
/// share of the largest entry, and principal moments may violate the triangle inequality by it.
/// Numbers from drawings are rounded. \[-\]
const ROUNDED: f64 = 1e-9;

impl Solid {
    /// Returns the reason why no body can have this mass and this inertia, if there is one. In a
    /// plane only the moment about z counts.
    pub(crate) fn refusal(&self, planar: bool) -> Option<String> {
        let [x, y, z] = self.centre.to_array();
        let rows = self.inertia.to_array();
        if !(self.mass.is_finite() && self.mass > 0.0) {
            return Some(format!("the mass is {}. Give a value above zero", self.mass));
        }
        if let Some(bad) = [x, y, z].into_iter().find(|x| !x.is_finite()) {
            return Some(format!("a coordinate of the centre is {bad}. Give finite numbers"));
        }
        if let Some(bad) = rows.iter().flatten().find(|x| !x.is_finite()) {
            return Some(format!("an entry of the inertia is {bad}. Give finite numbers"));
        }
        if planar {
            let moment = self.inertia.m33;
            return (moment < 0.0)
                .then(|| format!("the moment of inertia is {moment}, below zero"));
        }
        self.impossible(&rows)
    }

    /// Returns the reason why no body can have this finite tensor, if there is one.
    fn impossible(&self, rows: &[[f64; 3]; 3]) -> Option<String> {
        let largest = rows.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if (rows[i][j] - rows[j][i]).abs() > ROUNDED * largest {
                return Some(format!(
                    "the inertia is not symmetric: the entry {} in row {}, column {} differs from the opposite entry {}",
                    rows[i][j],
                    i + 1,
                    j + 1,
                    rows[j][i]
                ));
            }
        }
        let mut principal =
            nalgebra::SymmetricEigen::new(nalgebra::Matrix3::from(self.inertia)).eigenvalues;
        principal.as_mut_slice().sort_by(f64::total_cmp);
        let [a, b, c] = [principal[0], principal[1], principal[2]];
        if a < -ROUNDED * largest {
            return Some(format!("the inertia has the principal moment {a}, below zero"));
        }
        (c > a + b + ROUNDED * largest).then(|| {
            format!(
                "no body has the principal moments {a}, {b} and {c}: the largest moment is more than the sum of the others. Give the tensor about the centre of mass, and check the signs of the products of inertia"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::algebra::{Mat3, Vec3};

    fn refused(mass: f64, rows: [[f64; 3]; 3]) -> String {
        let solid = Solid { mass, centre: Vec3::zeros(), inertia: Mat3::from(rows) };
        solid.refusal(false).unwrap_or_default()
    }

    #[test]
    fn inertia_that_no_body_can_have_is_told() {
        let diagonal = |a: f64, b: f64, c: f64| [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]];
        assert_eq!(refused(1.0, diagonal(1.0, 2.0, 3.0)), "");
        assert_eq!(refused(1.0, diagonal(0.0, 0.0, 0.0)), "");
        assert!(refused(0.0, diagonal(1.0, 1.0, 1.0)).starts_with("the mass is 0"));
        assert!(refused(f64::NAN, diagonal(1.0, 1.0, 1.0)).starts_with("the mass is NaN"));
        assert!(refused(1.0, diagonal(1.0, 2.0, 3.1)).contains("more than the sum"));
        assert!(refused(1.0, diagonal(-1.0, 2.0, 2.0)).contains("below zero"));
        assert!(refused(1.0, diagonal(f64::INFINITY, 2.0, 2.0)).contains("inf"));
        let mut rows = diagonal(1.0, 1.0, 1.0);
        rows[0][1] = 0.1;
        assert!(refused(1.0, rows).contains("not symmetric"));
    }
}
