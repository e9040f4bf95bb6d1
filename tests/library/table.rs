//! The table of all joints: a name's constraint with random parameters, and where two bodies may be
//! exchanged, how.

use kin::check::{any_coord as c, any_planar as p, any_spatial as s};
use kin::prelude::*;

use crate::sample::{Random, Sample, sample};

type Make = fn(&mut Random) -> Box<dyn Sample>;

/// A line of the table.
pub struct Joint {
    /// `planar`, `spatial` or `drivers`.
    pub group: &'static str,
    pub make: Make,
    /// The same joint with its bodies exchanged; it draws the same parameters in the same order.
    pub exchanged: Option<Make>,
}

impl Joint {
    fn exchanged(self, make: Make) -> Joint {
        Joint { exchanged: Some(make), ..self }
    }

    pub fn name(&self) -> String {
        (self.make)(&mut Random::new(0)).constraint().facts().kind.to_owned()
    }
}

pub fn all() -> Vec<Joint> {
    [
        planar(),
        planar_drivers(),
        spatial_points(),
        spatial_joints(),
        spatial_couplings(),
        spatial_links(),
        spatial_drivers(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn planar() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "planar", make, exchanged: None };
    vec![
        of(|r| sample(fixed(p(), r.v2(), r.number()))),
        of(|r| sample(revolute(p(), p(), r.v2(), r.v2()))).exchanged(|r| {
            let u_i = r.v2();
            let u_j = r.v2();
            sample(revolute(p(), p(), u_j, u_i))
        }),
        of(|r| sample(weld(p(), p(), r.v2(), r.v2(), r.number()))).exchanged(|r| {
            let u_i = r.v2();
            let u_j = r.v2();
            let theta0 = r.number();
            sample(weld(p(), p(), u_j, u_i, -theta0))
        }),
        of(|r| sample(prismatic(p(), p(), r.v2(), r.v2(), r.v2(), r.number()))).exchanged(|r| {
            let u_i = r.v2();
            let u_j = r.v2();
            let h_i = r.v2();
            let theta0 = r.number();
            // the direction across the slide, as the other body sees it
            sample(prismatic(p(), p(), u_j, u_i, Mat2::rotation(theta0) * h_i, -theta0))
        }),
        of(|r| sample(distance(p(), p(), r.v2(), r.v2(), r.length()))).exchanged(|r| {
            let u_i = r.v2();
            let u_j = r.v2();
            let length = r.length();
            sample(distance(p(), p(), u_j, u_i, length))
        }),
        of(|r| sample(angle(p(), p(), r.number())))
            .exchanged(|r| sample(angle(p(), p(), -r.number()))),
        of(|r| sample(parallel(p(), p(), r.v2(), r.v2()))).exchanged(|r| {
            let h_i = r.v2();
            let h_j = r.v2();
            sample(parallel(p(), p(), h_j, h_i))
        }),
        of(|r| sample(point_on_line(p(), p(), r.v2(), r.v2(), r.v2()))),
        of(|r| sample(pin_in_slot(p(), p(), r.v2(), r.v2(), r.v2()))),
        of(|r| sample(point_on_circle(p(), p(), r.v2(), r.v2(), r.length()))).exchanged(|r| {
            let u_i = r.v2();
            let c_j = r.v2();
            let radius = r.length();
            sample(point_on_circle(p(), p(), c_j, u_i, radius))
        }),
        of(|r| sample(point_on_curve(p(), p(), r.v2(), r.law()))),
        of(|r| sample(cam_knife_edge(p(), p(), r.v2(), r.profile()))),
        of(|r| sample(cam_flat_face(p(), p(), r.v2(), r.v2(), r.profile()))),
        of(|r| sample(cam_roller(p(), p(), c(), r.v2(), r.length(), r.profile()))),
        of(|r| sample(gear(p(), p(), p(), r.length(), r.length(), r.number()))),
        of(|r| sample(internal_gear(p(), p(), p(), r.length(), 2.0 + r.length(), r.number()))),
        of(|r| sample(belt(p(), p(), p(), r.length(), r.length(), r.number()))),
        of(|r| sample(rack_and_pinion(p(), p(), r.v2(), r.v2(), r.v2(), r.length(), r.number()))),
        of(|r| sample(rolling(p(), p(), r.v2(), r.v2(), r.v2(), r.length(), r.number()))),
        of(|r| sample(coupling(c(), c(), r.length(), r.number(), r.number()))).exchanged(|r| {
            let k_a = r.length();
            let k_b = r.number();
            let value = r.number();
            sample(coupling(c(), c(), k_b, k_a, value))
        }),
        of(|r| {
            sample(linear_coupling(
                [c(), c(), c()],
                [r.length(), r.number(), r.number()],
                r.number(),
            ))
        }),
        of(|r| sample(moving_point(p(), p(), r.law(), r.law(), r.v2()))),
        of(|r| sample(point_on_path(p(), p(), c(), r.law(), r.law(), r.v2()))),
    ]
}

fn planar_drivers() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "drivers", make, exchanged: None };
    vec![
        of(|r| sample(drive(c(), r.law()))),
        of(|r| sample(drive_angle(p(), r.law()))),
        of(|r| sample(drive_relative_angle(p(), p(), r.law())))
            .exchanged(|r| sample(drive_relative_angle(p(), p(), -r.law()))),
        of(|r| sample(drive_slide(p(), p(), r.v2(), r.v2(), r.v2(), r.law()))),
        of(|r| sample(drive_distance(p(), p(), r.v2(), r.v2(), r.profile()))).exchanged(|r| {
            let u_i = r.v2();
            let u_j = r.v2();
            let law = r.profile();
            sample(drive_distance(p(), p(), u_j, u_i, law))
        }),
        of(|r| sample(drive_point(p(), r.v2(), r.law(), r.law()))),
        of(|r| sample(drive_point_along(p(), r.v2(), r.v2(), r.law()))),
    ]
}

fn spatial_points() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "spatial", make, exchanged: None };
    vec![
        of(|r| sample(spatial::spherical(s(), s(), r.v3(), r.v3()))).exchanged(|r| {
            let u_i = r.v3();
            let u_j = r.v3();
            sample(spatial::spherical(s(), s(), u_j, u_i))
        }),
        of(|r| sample(spatial::distance(s(), s(), r.v3(), r.v3(), r.length()))).exchanged(|r| {
            let u_i = r.v3();
            let u_j = r.v3();
            let length = r.length();
            sample(spatial::distance(s(), s(), u_j, u_i, length))
        }),
        of(|r| sample(spatial::point_on_line(s(), s(), r.v3(), r.v3(), r.axis()))),
        of(|r| sample(spatial::point_in_plane(s(), s(), r.v3(), r.v3(), r.v3()))),
        of(|r| sample(spatial::point_coordinate(s(), r.v3(), r.v3(), r.number()))),
        of(|r| sample(spatial::parallel(s(), s(), r.axis(), r.v3()))).exchanged(|r| {
            let h_i = r.axis();
            let h_j = r.v3();
            sample(spatial::parallel(s(), s(), h_j, h_i.h))
        }),
        of(|r| sample(spatial::perpendicular(s(), s(), r.v3(), r.v3()))).exchanged(|r| {
            let h_i = r.v3();
            let h_j = r.v3();
            sample(spatial::perpendicular(s(), s(), h_j, h_i))
        }),
        of(|r| sample(spatial::angle(s(), s(), r.axis(), r.axis(), r.length()))).exchanged(|r| {
            let h_i = r.axis();
            let h_j = r.axis();
            let alpha = r.length();
            sample(spatial::angle(s(), s(), h_j, h_i, alpha))
        }),
        of(|r| sample(spatial::moving_point(s(), s(), r.law(), r.law(), r.law(), r.v3()))),
        of(|r| sample(spatial::point_on_path(s(), s(), c(), r.law(), r.law(), r.law(), r.v3()))),
    ]
}

fn spatial_joints() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "spatial", make, exchanged: None };
    vec![
        of(|r| sample(spatial::fixed(s(), r.v3(), r.turn()))),
        of(|r| sample(spatial::weld(s(), s(), r.v3(), r.v3(), r.turn()))).exchanged(|r| {
            let u_i = r.v3();
            let u_j = r.v3();
            let p_ij = r.turn();
            sample(spatial::weld(s(), s(), u_j, u_i, p_ij.conjugate()))
        }),
        of(|r| sample(spatial::revolute(s(), s(), r.v3(), r.v3(), r.axis(), r.v3()))).exchanged(
            |r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.axis();
                let h_j = r.v3();
                sample(spatial::revolute(s(), s(), u_j, u_i, h_j, h_i.h))
            },
        ),
        of(|r| sample(spatial::prismatic(s(), s(), r.v3(), r.v3(), r.axis(), r.turn()))).exchanged(
            |r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.axis();
                let p_ij = r.turn();
                // the slide as the other body sees it
                sample(spatial::prismatic(
                    s(),
                    s(),
                    u_j,
                    u_i,
                    p_ij.rotation() * h_i.h,
                    p_ij.conjugate(),
                ))
            },
        ),
        of(|r| sample(spatial::cylindrical(s(), s(), r.v3(), r.v3(), r.axis(), r.v3()))).exchanged(
            |r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.axis();
                let h_j = r.v3();
                sample(spatial::cylindrical(s(), s(), u_j, u_i, h_j, h_i.h))
            },
        ),
        of(|r| sample(spatial::universal(s(), s(), r.v3(), r.v3(), r.v3(), r.v3()))).exchanged(
            |r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.v3();
                let h_j = r.v3();
                sample(spatial::universal(s(), s(), u_j, u_i, h_j, h_i))
            },
        ),
        of(|r| sample(spatial::planar(s(), s(), r.v3(), r.v3(), r.axis(), r.v3()))).exchanged(
            |r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.axis();
                let h_j = r.v3();
                sample(spatial::planar(s(), s(), u_j, u_i, h_j, h_i.h))
            },
        ),
        of(|r| sample(spatial::screw(s(), s(), r.v3(), r.v3(), r.axis(), r.axis(), r.length())))
            .exchanged(|r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.axis();
                let h_j = r.axis();
                let lead = r.length();
                sample(spatial::screw(s(), s(), u_j, u_i, h_j, h_i, lead))
            }),
        of(|r| sample(spatial::constant_velocity(s(), s(), r.v3(), r.v3(), r.axis(), r.axis())))
            .exchanged(|r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let h_i = r.axis();
                let h_j = r.axis();
                sample(spatial::constant_velocity(s(), s(), u_j, u_i, h_j, h_i))
            }),
    ]
}

fn spatial_couplings() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "spatial", make, exchanged: None };
    vec![
        of(|r| sample(spatial::relative_angle(s(), s(), c(), r.axis(), r.axis()))),
        of(|r| {
            sample(spatial::gear(
                s(),
                s(),
                s(),
                r.axis(),
                r.axis(),
                r.axis(),
                r.axis(),
                3.0,
                -2.0,
                r.number(),
            ))
        }),
        of(|r| {
            let axes = [r.axis(), r.axis(), r.axis(), r.axis()];
            sample(spatial::gear_by_radii(
                s(),
                s(),
                s(),
                c(),
                axes[0],
                axes[1],
                axes[2],
                axes[3],
                r.length(),
                -r.length(),
                r.number(),
            ))
        }),
        of(|r| sample(spatial::thread(s(), s(), r.v3(), r.v3(), r.axis(), r.axis(), r.length()))),
        of(|r| {
            sample(spatial::rack_and_pinion(
                s(),
                s(),
                r.v3(),
                r.v3(),
                r.axis(),
                r.axis(),
                r.length(),
                r.number(),
            ))
        }),
    ]
}

fn spatial_links() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "spatial", make, exchanged: None };
    vec![
        of(|r| sample(spatial::revolute_spherical(s(), s(), r.v3(), r.v3(), r.v3(), r.length()))),
        of(|r| {
            sample(spatial::revolute_revolute(
                s(),
                s(),
                r.v3(),
                r.v3(),
                r.axis(),
                r.axis(),
                r.length(),
                r.number(),
            ))
        })
        .exchanged(|r| {
            let u_i = r.v3();
            let u_j = r.v3();
            let h_i = r.axis();
            let h_j = r.axis();
            let length = r.length();
            let twist = r.number();
            sample(spatial::revolute_revolute(s(), s(), u_j, u_i, h_j, h_i, length, twist))
        }),
        of(|r| {
            sample(spatial::revolute_cylindrical(
                s(),
                s(),
                r.v3(),
                r.v3(),
                r.axis(),
                r.axis(),
                r.length(),
                r.number(),
            ))
        }),
        of(|r| {
            sample(spatial::spherical_cylindrical(s(), s(), r.v3(), r.v3(), r.axis(), r.length()))
        }),
    ]
}

fn spatial_drivers() -> Vec<Joint> {
    let of = |make: Make| Joint { group: "spatial drivers", make, exchanged: None };
    vec![
        of(|r| sample(spatial::drive_turn(s(), s(), r.axis(), r.axis(), r.law()))),
        of(|r| sample(spatial::drive_slide(s(), s(), r.v3(), r.v3(), r.axis(), r.law()))),
        of(|r| sample(spatial::drive_distance(s(), s(), r.v3(), r.v3(), r.profile()))).exchanged(
            |r| {
                let u_i = r.v3();
                let u_j = r.v3();
                let law = r.profile();
                sample(spatial::drive_distance(s(), s(), u_j, u_i, law))
            },
        ),
        of(|r| sample(spatial::drive_point(s(), r.v3(), r.law(), r.law(), r.law()))),
        of(|r| sample(spatial::drive_point_along(s(), r.v3(), r.axis(), r.law()))),
        of(|r| sample(spatial::drive_rotation(s(), s(), r.axis(), r.law()))),
        of(|r| sample(spatial::drive_orientation(s(), s(), r.law(), r.law(), r.law()))),
        of(|r| {
            let u_i = r.v3();
            let u_j = r.v3();
            let p_i = r.turn();
            let p_j = r.turn();
            sample(spatial::drive_motion(
                s(),
                s(),
                u_i,
                u_j,
                p_i,
                p_j,
                r.law(),
                r.law(),
                r.law(),
                r.law(),
                r.law(),
                r.law(),
            ))
        }),
    ]
}
