//! Reads and writes masses and gravity as data.

use serde::{Deserialize, Serialize};

use crate::coordinates::Target;
use crate::data::dimension::{NumberData, Texts};
use crate::dimensions::{Beside, Dimension};
use crate::model::loads::Solid;
use crate::model::mechanism::Mechanism;
use crate::numbers::algebra::{Mat3, Vec3};
use crate::outcome::error::{Error, Result};

/// The mass of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MassData {
    /// The name of the body.
    pub body: String,
    /// The mass.
    pub mass: NumberData,
    /// The centre of mass in the frame of the body; z is 0 in a plane.
    pub centre: [NumberData; 3],
    /// The inertia about the centre of mass in the axes of the body, by rows; a planar body uses
    /// only the last number.
    pub inertia: [[NumberData; 3]; 3],
}

/// The names of the entries of an inertia, by rows.
const ENTRIES: [[&str; 3]; 3] = [
    ["inertia.m11", "inertia.m12", "inertia.m13"],
    ["inertia.m21", "inertia.m22", "inertia.m23"],
    ["inertia.m31", "inertia.m32", "inertia.m33"],
];

const CENTRE: [&str; 3] = ["centre.x", "centre.y", "centre.z"];

impl Mechanism {
    /// Returns masses and gravity as data.
    pub(in crate::data) fn mass_data(
        &self,
        texts: &Texts,
    ) -> (Vec<MassData>, Option<[NumberData; 3]>) {
        let data = |(item, solid): &(usize, Solid)| {
            let of = Beside::Solid(*item);
            let [mass] = texts.beside(&of, ["mass"], [solid.mass]);
            let centre = texts.beside(&of, CENTRE, solid.centre.to_array());
            let [row1, row2, row3] = solid.inertia.to_array();
            let [m1, m2, m3] = ENTRIES;
            let mut inertia = [
                texts.beside(&of, m1, row1),
                texts.beside(&of, m2, row2),
                texts.beside(&of, m3, row3),
            ];
            // The moment of a body in a plane.
            if let [NumberData::Expression(text)] = texts.beside(&of, ["inertia"], [0.0]) {
                (0..3).for_each(|k| inertia[k][k] = NumberData::Expression(text.clone()));
            }
            MassData { body: self.layout.items[*item].name.clone(), mass, centre, inertia }
        };
        let gravity = texts.beside(&Beside::Gravity, ["g.x", "g.y", "g.z"], self.loads.gravity);
        let none = gravity.iter().all(|g| *g == NumberData::Number(0.0));
        (self.loads.solids.iter().map(data).collect(), Some(gravity).filter(|_| !none))
    }

    /// Adds masses and gravity from data. Errors: a name that no body has, those of
    /// [`Mechanism::mass`].
    pub(in crate::data) fn take_masses(
        &mut self,
        masses: &[MassData],
        gravity: Option<&[NumberData; 3]>,
    ) -> Result<()> {
        for MassData { body, mass, centre, inertia } in masses {
            let place = format!("mass of `{body}`");
            let number = |number: &NumberData| self.number(&place, number);
            let all = std::iter::once(mass).chain(centre).chain(inertia.as_flattened());
            let all = all.map(number).collect::<Result<Vec<Dimension>>>()?;
            let names = ["mass"].into_iter().chain(CENTRE).chain(ENTRIES.into_iter().flatten());
            let values: Vec<f64> = all.iter().map(|x| x.value()).collect();
            let [m, x, y, z, j @ ..] = &values[..] else { continue };
            let rows = [0, 3, 6].map(|k| [j[k], j[k + 1], j[k + 2]]);
            let solid =
                Solid { mass: *m, centre: Vec3::new(*x, *y, *z), inertia: Mat3::from(rows) };
            let bound = names.map(str::to_string).zip(all).collect();
            let bodies = self.layout.bodies();
            let target = bodies.iter().find(|(known, _)| known == body).map(|(_, target)| *target);
            match target {
                Some(Target::Planar(found)) => self.weigh(found, solid, bound)?,
                Some(Target::Spatial(found)) => self.weigh(found, solid, bound)?,
                _ => {
                    return Err(Error::UnknownName {
                        what: "body",
                        name: body.clone(),
                        known: bodies.iter().map(|(known, _)| known.to_string()).collect(),
                    });
                }
            }
        }
        if let Some([x, y, z]) = gravity {
            let number = |g: &NumberData| self.number("gravity", g);
            let gravity = [number(x)?, number(y)?, number(z)?];
            self.gravity(Vec3::from(gravity));
        }
        Ok(())
    }
}
