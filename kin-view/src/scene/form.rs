//! Defines the shapes of bodies that joints of the library determine: wheels, belts, racks, cams
//! and their followers.

use std::collections::HashMap;
use std::f64::consts::TAU;

use kin::extend::Target;
use kin::extend::state::{At, Offsets};
use kin::{Constraint, Law, Vec2, vec2};

use super::outline::polar;

/// The shape of a joint. Its bodies count as in the joint's signature.
#[derive(Clone, Debug)]
pub(crate) enum Form {
    /// Wheels of bodies 0 and 1 that mesh; their axles sit on body 2. The second one may be a ring.
    Gears { radii: [f64; 2], phase: f64, ring: bool },
    /// A belt over pulleys of bodies 0 and 1 with axles on body 2; it is crossed if one radius is
    /// below zero.
    Belt { radii: [f64; 2] },
    /// A wheel of body 0 on a line of body 1, through a point along a direction of length 1, with
    /// the wheel to its left (a negative radius: to its right).
    Rolling { centre: Vec2, radius: f64, from: Vec2, along: Vec2, phase: f64, teeth: bool },
    /// A cam, body 0, by its edge, with what the follower, body 1, touches it with.
    Cam { edge: Vec<Vec2>, touch: Touch },
}

/// Followers that touch a cam.
#[derive(Clone, Debug)]
pub(crate) enum Touch {
    /// The point of the follower is all there is.
    Edge,
    Roller {
        centre: Vec2,
        radius: f64,
    },
    /// A flat face through a point, with the direction away from the cam; the point of contact lies
    /// this far to the left of the cam's centre.
    Face {
        at: Vec2,
        normal: Vec2,
        contact: [f64; 2],
    },
}

/// At how many angles the edge of a cam is drawn.
const EDGE: usize = 720;

impl Form {
    /// The shape of a planar joint of the library; `None` of all others, and where a parameter
    /// makes no sense.
    pub fn of(constraint: &dyn Constraint) -> Option<Form> {
        let planar = |argument: &kin::extend::coordinates::Argument| {
            matches!(argument.target, Target::Planar(_))
        };
        if !constraint.arguments().first().is_some_and(planar) {
            return None;
        }
        let numbers = Numbers::by(constraint);
        let radii = || Some([numbers.number("r_i")?, numbers.number("r_j")?]);
        Some(match constraint.facts().kind {
            "gear" => Form::Gears { radii: radii()?, phase: numbers.number("phase")?, ring: false },
            "internal_gear" => {
                Form::Gears { radii: radii()?, phase: numbers.number("phase")?, ring: true }
            }
            "belt" => Form::Belt { radii: radii()? },
            "rack_and_pinion" => numbers.rolling(true)?,
            "rolling" => numbers.rolling(false)?,
            "cam_knife_edge" => {
                Form::Cam { edge: edge(&law(constraint, "profile")?)?, touch: Touch::Edge }
            }
            "cam_roller" => {
                let touch = Touch::Roller {
                    centre: numbers.point("centre")?,
                    radius: numbers.number("radius")?,
                };
                Form::Cam { edge: edge(&law(constraint, "profile")?)?, touch }
            }
            "cam_flat_face" => numbers.flat_face(&law(constraint, "support")?)?,
            _ => return None,
        })
    }
}

/// The numbers of a constraint by their names.
struct Numbers(HashMap<String, f64>);

impl Numbers {
    fn by(constraint: &dyn Constraint) -> Numbers {
        let mut all = HashMap::new();
        constraint.parameters(&mut |name, value| {
            all.insert(name.to_string(), value);
        });
        Numbers(all)
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.0.get(name).copied().filter(|x| x.is_finite())
    }

    fn point(&self, name: &str) -> Option<Vec2> {
        Some(vec2(self.number(&format!("{name}.x"))?, self.number(&format!("{name}.y"))?))
    }

    fn direction(&self, name: &str) -> Option<Vec2> {
        let h = self.point(name)?;
        (h.norm() > 0.0).then(|| h / h.norm())
    }

    fn rolling(&self, teeth: bool) -> Option<Form> {
        let centre = self.point("u_i")?;
        let from = self.point("u_j")?;
        let along = self.direction("h_j")?;
        Some(Form::Rolling {
            centre,
            radius: self.number("radius")?,
            from,
            along,
            phase: self.number("phase")?,
            teeth,
        })
    }

    /// The edge of a cam from the distance h of its tangents: h n + h′ t, t to the left of n.
    fn flat_face(&self, support: &Law) -> Option<Form> {
        let at = |k: usize| {
            let angle = TAU * k as f64 / EDGE as f64;
            let [h, slope, ..] = support.jet(angle);
            (polar(h, angle) + polar(1.0, angle).perp() * slope, slope)
        };
        let (edge, slopes): (Vec<Vec2>, Vec<f64>) = (0..EDGE).map(at).unzip();
        let contact =
            slopes.iter().fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(*x), high.max(*x)]);
        let touch = Touch::Face { at: self.point("u")?, normal: self.direction("n")?, contact };
        finite(edge).map(|edge| Form::Cam { edge, touch })
    }
}

/// The law of a constraint by its name.
fn law(constraint: &dyn Constraint, name: &str) -> Option<Law> {
    // Laws are shown at a state; which one does not matter.
    let states = [0.0, 0.0, 0.0, 0.0, 1.0];
    let begins = vec![Offsets::new(0, 0); constraint.arguments().len()];
    let mut found = None;
    constraint.laws(&At::new(0.0, &states, &begins), &mut |known, law, _| {
        if known == name {
            found = Some(law.clone());
        }
    });
    found
}

/// The edge of a cam from its distance from the axle.
fn edge(profile: &Law) -> Option<Vec<Vec2>> {
    let angle = |k: usize| TAU * k as f64 / EDGE as f64;
    finite((0..EDGE).map(angle).map(|angle| polar(profile.at(angle), angle)).collect())
}

fn finite(points: Vec<Vec2>) -> Option<Vec<Vec2>> {
    points.iter().all(|p| p.x.is_finite() && p.y.is_finite()).then_some(points)
}
