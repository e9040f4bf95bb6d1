//! Draws wheels, belts, racks, cams and their followers, as shapes on tracks.

use std::f64::consts::{PI, TAU};

use kin::{Vec2, Vec3, vec2};

use super::Style;
use super::joints::{Held, Samples};
use super::wheels::{Wheel, disc, pitch};
use crate::scene::{Form, Touch};

/// A shape of a joint on one of its bodies.
pub(super) struct Piece {
    pub track: usize,
    pub points: Vec<Vec3>,
    pub style: Style,
}

/// Everything that joints know of the shapes of their bodies.
pub(super) fn pieces(joints: &[(String, Held)], samples: &Samples) -> Vec<Piece> {
    let shown = || joints.iter().map(|(_, joint)| joint).filter(|joint| !joint.hidden);
    let mut all =
        Pieces { joints, samples, wheels: Vec::new(), racks: Vec::new(), pieces: Vec::new() };
    for joint in shown() {
        match &joint.form {
            Some(Form::Gears { radii, ring, .. }) => all.gears(joint, *radii, *ring),
            Some(Form::Belt { radii }) => all.belt(joint, *radii),
            Some(Form::Rolling { .. }) => all.rolling(joint),
            Some(Form::Cam { edge, touch }) => all.cam(joint, edge, touch),
            None => {}
        }
    }
    // Each pass of the loop tells where the teeth of one more wheel stand, as far as they mesh.
    for _ in 0..all.wheels.len() {
        shown().for_each(|joint| all.mesh(joint));
    }
    all.finish()
}

struct Pieces<'a> {
    joints: &'a [(String, Held)],
    samples: &'a Samples,
    wheels: Vec<Wheel>,
    /// Racks: a body, its pitch line, and where a tooth stands on it, from its first end.
    racks: Vec<(usize, [Vec2; 2], Vec2)>,
    pieces: Vec<Piece>,
}

impl Pieces<'_> {
    fn add(&mut self, track: usize, points: impl IntoIterator<Item = Vec2>, style: Style) {
        let points = points.into_iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect();
        self.pieces.push(Piece { track, points, style });
    }

    /// Where the axle of a wheel is in its body: a point at which it is held that stays where it is
    /// on the frame, else its origin.
    fn axle(&self, wheel: usize, frame: usize) -> Vec2 {
        let held = self
            .joints
            .iter()
            .flat_map(|(_, joint)| &joint.points)
            .filter(|(track, _)| *track == wheel);
        let stays = |p: &&(usize, Vec3)| self.samples.stays(**p, frame);
        held.into_iter().find(stays).map_or(vec2(0.0, 0.0), |(_, p)| vec2(p.x, p.y))
    }

    fn wheel(&mut self, wheel: Wheel) {
        let same = |known: &Wheel| {
            known.track == wheel.track && (known.radius - wheel.radius).abs() <= 1e-9 * wheel.radius
        };
        if !self.wheels.iter().any(same) {
            self.wheels.push(wheel);
        }
    }

    fn gears(&mut self, joint: &Held, radii: [f64; 2], ring: bool) {
        let [i, j, arm] = joint.tracks[..] else { return };
        for (track, radius, ring) in [(i, radii[0], false), (j, radii[1], ring)] {
            self.wheel(Wheel {
                track,
                centre: self.axle(track, arm),
                radius,
                ring,
                toothed: true,
                tooth: None,
            });
        }
    }

    /// Where the teeth of one wheel of a pair stand, if that is known of the other: both are turned
    /// until a tooth stands at the pitch point.
    fn mesh(&mut self, joint: &Held) {
        match (&joint.form, &joint.tracks[..]) {
            (Some(Form::Gears { radii: [r_i, r_j], phase, ring }), &[i, j, arm]) => {
                let place = |track: usize, radius: f64| {
                    self.wheels.iter().position(|w| w.track == track && w.radius == radius)
                };
                let (Some(a), Some(b)) = (place(i, *r_i), place(j, *r_j)) else { return };
                let [at_i, at_j] = [a, b].map(|k| {
                    self.samples.seen((self.wheels[k].track, lifted(self.wheels[k].centre)), arm)
                });
                let beta = (at_i.y - at_j.y).atan2(at_i.x - at_j.x);
                let sense = if *ring { -1.0 } else { 1.0 };
                let gamma = if *ring { beta } else { beta + PI };
                match (self.wheels[a].tooth, self.wheels[b].tooth) {
                    (Some(_), Some(_)) => {}
                    (Some(tooth), None) => {
                        self.wheels[b].tooth =
                            Some(beta + sense * r_i / r_j * (gamma - tooth - phase))
                    }
                    (None, known) => {
                        let tooth = known.unwrap_or(beta);
                        self.wheels[a].tooth =
                            Some(gamma - phase + sense * r_j / r_i * (beta - tooth));
                        self.wheels[b].tooth = Some(tooth);
                    }
                }
            }
            (Some(Form::Rolling { radius, along, phase, .. }), &[i, _]) => {
                let across = along.perp() * -radius.signum();
                let tooth = across.y.atan2(across.x) - phase;
                if let Some(wheel) = self
                    .wheels
                    .iter_mut()
                    .find(|w| w.track == i && w.radius == radius.abs() && w.tooth.is_none())
                {
                    wheel.tooth = Some(tooth);
                }
            }
            _ => {}
        }
    }

    fn rolling(&mut self, joint: &Held) {
        let (Some(Form::Rolling { centre, radius, from, along, teeth, .. }), &[i, j]) =
            (&joint.form, &joint.tracks[..])
        else {
            return;
        };
        self.wheel(Wheel {
            track: i,
            centre: *centre,
            radius: radius.abs(),
            ring: false,
            toothed: *teeth,
            tooth: None,
        });
        let ways = self
            .samples
            .relative((i, lifted(*centre)), j)
            .into_iter()
            .map(|p| along.dot(vec2(p.x, p.y) - *from));
        let (low, high) = ways
            .filter(|x| x.is_finite())
            .fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            return;
        }
        let line = [low - radius.abs(), high + radius.abs()].map(|x| *from + *along * x);
        match teeth {
            // Teeth point to the wheel.
            true => self.racks.push((j, line, along.perp() * -radius.signum())),
            false => self.add(j, line, Style::Guide),
        }
    }

    fn belt(&mut self, joint: &Held, [r_i, r_j]: [f64; 2]) {
        let [i, j, frame] = joint.tracks[..] else { return };
        let centres = [i, j].map(|track| self.axle(track, frame));
        for (track, centre, radius) in [(i, centres[0], r_i), (j, centres[1], r_j)] {
            self.wheel(Wheel {
                track,
                centre,
                radius: radius.abs(),
                ring: false,
                toothed: false,
                tooth: Some(0.0),
            });
        }
        let [at_i, at_j] = [(i, centres[0]), (j, centres[1])]
            .map(|(track, centre)| self.samples.seen((track, lifted(centre)), frame));
        let line = at_j - at_i;
        let crossed = r_i * r_j < 0.0;
        let r_i = r_i.abs();
        let r_j = r_j.abs();
        let share = (if crossed { r_i + r_j } else { r_i - r_j }) / line.norm();
        if share.is_nan() || share.abs() >= 1.0 {
            return; // One pulley stands within the other.
        }
        let towards = line.y.atan2(line.x);
        let half = share.acos();
        let arc = |centre: Vec2, radius: f64, from: f64, to: f64| {
            (0..=32)
                .map(move |k| centre + disc_point(radius, from + (to - from) * f64::from(k) / 32.0))
        };
        let round_i = arc(at_i, r_i, towards + half, towards + TAU - half);
        let round_j = match crossed {
            true => arc(at_j, r_j, towards + PI - half, towards - PI + half),
            false => arc(at_j, r_j, towards - half, towards + half),
        };
        let belt: Vec<Vec2> = round_i.chain(round_j).collect();
        let closed: Vec<Vec2> = belt.iter().chain(belt.first()).copied().collect();
        self.add(frame, closed, Style::Slot);
    }

    fn cam(&mut self, joint: &Held, edge: &[Vec2], touch: &Touch) {
        let [cam, follower, ..] = joint.tracks[..] else { return };
        self.add(cam, edge.iter().copied(), Style::Plate);
        match touch {
            Touch::Edge => {}
            Touch::Roller { centre, radius } if *radius > 0.0 => {
                self.add(follower, disc(*centre, *radius), Style::Plate)
            }
            Touch::Roller { .. } => {}
            Touch::Face { at, normal, contact: [low, high] } => {
                // Seen from the cam's centre the point of the face wanders, and so does the point
                // of contact.
                let along = normal.perp();
                let ways =
                    self.samples.relative((cam, lifted(vec2(0.0, 0.0))), follower).into_iter();
                let ways = ways.map(|p| along.dot(vec2(p.x, p.y) - *at)).filter(|x| x.is_finite());
                let (least, most) =
                    ways.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
                if least <= most {
                    let room = 0.15 * (high - low + most - least);
                    self.add(
                        follower,
                        [least + low - room, most + high + room].map(|x| *at + along * x),
                        Style::Bar,
                    );
                }
            }
        }
    }

    fn finish(mut self) -> Vec<Piece> {
        let radii: Vec<f64> =
            self.wheels.iter().filter(|wheel| wheel.toothed).map(|wheel| wheel.radius).collect();
        let pitch = pitch(&radii);
        for wheel in std::mem::take(&mut self.wheels) {
            for (points, style) in wheel.drawn(pitch) {
                self.add(wheel.track, points, style);
            }
        }
        for (track, [from, to], outwards) in std::mem::take(&mut self.racks) {
            let points = rack([from, to], outwards, pitch);
            self.add(track, points, Style::Guide);
        }
        self.pieces
    }
}

/// The pitch line of a rack with its teeth marked away from the wheel, from its middle on.
fn rack([from, to]: [Vec2; 2], away: Vec2, pitch: Option<f64>) -> Vec<Vec2> {
    let along = (to - from) / (to - from).norm();
    let Some(pitch) = pitch else { return vec![from, to] };
    let count = ((to - from).norm() / pitch) as usize;
    let teeth = (1..=count.min(400))
        .map(|k| from + along * (pitch * k as f64))
        .flat_map(|p| [p, p + away * (0.35 * pitch), p]);
    [from].into_iter().chain(teeth).chain([to]).collect()
}

fn disc_point(radius: f64, angle: f64) -> Vec2 {
    vec2(radius * angle.cos(), radius * angle.sin())
}

fn lifted(p: Vec2) -> Vec3 {
    Vec3::new(p.x, p.y, 0.0)
}
