//! Determines the shapes of bodies: the shapes that the user gave, or shapes from the points at
//! which constraints hold the bodies.

use std::f64::consts::TAU;

use kin::{Vec2, Vec3, vec2};

use super::forms::Piece;
use super::hull::{Spread, rounded, spread};
use super::joints::{Drawn, Held, Slot, is_closed};
use super::turns::perpendicular;
use super::{Drawing, GROUND, Shape, Style, link_ends};
use crate::color::PALETTE;
use crate::figure::thinned_path;
use crate::scene::{Look, Outline, OutlineKind, Scene};

/// Half the width of a bar, and half the sides of a block in a guide, as shares of the size of all.
const BAR: f64 = 0.016;
const BLOCK: [f64; 2] = [0.045, 0.028];
/// How long the mark is that shows a body turn, as a share of the size of all.
const MARK: f64 = 0.04;

impl Drawing {
    /// Shapes of the ground, then of the bodies in their order.
    pub(super) fn draw_bodies(
        &mut self,
        scene: &Scene,
        held: &[(String, Held)],
        drawn: &[(&String, Drawn)],
        still: &[bool],
        pieces: Vec<Piece>,
    ) {
        let ground = &scene.ground;
        let color = ground.color.as_deref().unwrap_or(GROUND);
        if !ground.hidden && ground.outlines.is_empty() {
            self.draw_pieces(ground, 0, color, &pieces);
        }
        for outline in ground.outlines.iter().chain(&ground.added).filter(|_| !ground.hidden) {
            let style =
                if outline.kind == OutlineKind::Filled { Style::Plate } else { Style::Guide };
            self.shape(&ground.name, 0, outline.points.clone(), style, color);
        }
        let slots: Vec<(&String, &Slot)> =
            drawn.iter().filter_map(|(name, joint)| Some((*name, joint.slot.as_ref()?))).collect();
        for (name, slot) in slots.iter().filter(|(_, slot)| slot.track == 0) {
            self.draw_slot(name, slot, GROUND, true);
        }
        for (k, look) in scene.looks.iter().enumerate().filter(|(_, look)| !look.hidden) {
            let track = k + 1;
            let color = match &look.color {
                Some(color) => color.as_str(),
                None if still[track] => GROUND,
                None => PALETTE[k % PALETTE.len()],
            };
            let own: Vec<_> =
                slots.iter().copied().filter(|(_, slot)| slot.track == track).collect();
            if look.outlines.is_empty() {
                self.draw_pieces(look, track, color, &pieces);
            }
            match look.outlines.is_empty() {
                // Points of what stands still are marked as supports; only a link is known to be
                // more than that.
                true if still[track] && look.length.is_none() => {}
                true => {
                    self.draw_by_points(look, track, color, self.held_at((track, look), held, &own))
                }
                false => self.draw_told(&look.outlines, look, track, color),
            }
            self.draw_told(&look.added, look, track, color);
            for (name, slot) in &own {
                self.draw_slot(name, slot, color, still[track]);
            }
            let planar = self.planar && look.outlines.is_empty();
            for (_, slot) in slots.iter().filter(|(_, slot)| {
                planar && slot.runner.0 == track && slot.guided && slot.straight
            }) {
                self.draw_block(look, slot, color);
            }
        }
    }

    /// Where a body is held, in its frame: points of joints and traces, the ends of a link, and its
    /// slots.
    fn held_at(
        &self,
        (track, look): (usize, &Look),
        held: &[(String, Held)],
        slots: &[(&String, &Slot)],
    ) -> Vec<Vec3> {
        let mut points: Vec<Vec3> = Vec::new();
        let mut add = |p: Vec3| {
            if p.norm().is_finite()
                && !points.iter().any(|known| (*known - p).norm() < 1e-6 * self.size)
            {
                points.push(p);
            }
        };
        held.iter()
            .flat_map(|(_, joint)| &joint.points)
            .filter(|(known, _)| *known == track)
            .for_each(|(_, p)| add(*p));
        link_ends(look).for_each(&mut add);
        self.traces.iter().filter(|trace| trace.track == track).for_each(|trace| add(trace.local));
        let open = slots.iter().filter(|(_, slot)| !is_closed(&slot.path));
        open.flat_map(|(_, slot)| self.thinned(&slot.path)).for_each(add);
        points
    }

    /// The shapes that joints know of a body.
    fn draw_pieces(&mut self, look: &Look, track: usize, color: &str, pieces: &[Piece]) {
        for piece in pieces.iter().filter(|piece| piece.track == track) {
            let style =
                if track == 0 && piece.style == Style::Slot { Style::Guide } else { piece.style };
            self.shape(&look.name, track, piece.points.clone(), style, color);
        }
    }

    fn draw_told(&mut self, outlines: &[Outline], look: &Look, track: usize, color: &str) {
        for outline in outlines {
            let style = match outline.kind {
                OutlineKind::Filled => Style::Plate,
                OutlineKind::Line => Style::Bar,
                OutlineKind::Edge => Style::Slot,
            };
            self.shape(&look.name, track, outline.points.clone(), style, color);
        }
    }

    fn draw_by_points(&mut self, look: &Look, track: usize, color: &str, mut points: Vec<Vec3>) {
        let origin = Vec3::new(0.0, 0.0, 0.0);
        let told_by_pieces = self.shapes.iter().any(|shape| shape.track == track);
        if points.len() < 2 && points.iter().all(|p| p.norm() > 1e-3 * self.size) {
            points.push(origin);
        }
        if self.planar {
            self.shape(&look.name, track, rounded(&points, BAR * self.size), Style::Plate, color);
            if let ([at], false) =
                (&points[..], told_by_pieces || self.tracks[track].keeps_its_angle())
            {
                let spoke = vec![*at, *at + Vec3::x() * (MARK * self.size)];
                self.shape(&look.name, track, spoke, Style::Slot, color);
            }
            return;
        }
        match spread(&points) {
            Spread::Line(points) => {
                self.draw_turn(look, track, color, &points);
                self.shape(&look.name, track, points, Style::Bar, color);
            }
            Spread::Plate(corners) => self.shape(&look.name, track, corners, Style::Plate, color),
            Spread::Star(lines) => lines
                .into_iter()
                .for_each(|line| self.shape(&look.name, track, line.to_vec(), Style::Bar, color)),
        }
    }

    /// Draws a disc with a spoke in the middle of a line that turns about itself. On a single point
    /// the disc stands across the axis about which the body turns. Without the disc nothing would
    /// be seen to move.
    fn draw_turn(&mut self, look: &Look, track: usize, color: &str, line: &[Vec3]) {
        /// Corners of the disc.
        const CORNERS: usize = 24;
        let samples = self.samples();
        let (at, along) = match line {
            [at] => (*at, samples.axis(track)),
            [from, to] => ((*from + *to) * 0.5, Some((*to - *from) / (*to - *from).norm())),
            _ => return,
        };
        let Some(along) = along.filter(|along| samples.turns_about(track, *along)) else { return };
        let x = perpendicular(along);
        let y = along.cross(x);
        let on = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / CORNERS as f64).sin_cos();
            at + (x * cos + y * sin) * (MARK * self.size)
        };
        let disc = (0..CORNERS).map(on).collect();
        let spoke = vec![at, on(0)];
        self.shape(&look.name, track, disc, Style::Plate, color);
        self.shape(&look.name, track, spoke, Style::Slot, color);
    }

    fn draw_slot(&mut self, name: &str, slot: &Slot, color: &str, still: bool) {
        let mut points = if self.planar { self.thinned(&slot.path) } else { slot.path.clone() };
        if slot.straight {
            points =
                ends(&slot.path, if slot.guided { (BLOCK[0] + 0.02) * self.size } else { 0.0 });
        }
        let closed = self.planar && !slot.straight && is_closed(&slot.path);
        let style = match (closed, still) {
            (true, _) => Style::Plate,
            (false, true) => Style::Guide,
            (false, false) => Style::Slot,
        };
        self.shape(name, slot.track, points, style, color);
    }

    /// A block on the runner's body, along the guide.
    fn draw_block(&mut self, look: &Look, slot: &Slot, color: &str) {
        let (track, at) = slot.runner;
        let line = ends(&slot.path, 0.0);
        let guide = self.tracks[slot.track].frame(0);
        let body = self.tracks[track].frame(0);
        let along = body.a.transpose() * (guide.a * (line[1] - line[0]));
        let x = vec2(along.x, along.y) / along.norm();
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
            let a = a * BLOCK[0] * self.size;
            let b = b * BLOCK[1] * self.size;
            at + Vec3::new(a * x.x - b * x.y, a * x.y + b * x.x, 0.0)
        });
        self.shape(&look.name, track, corners.to_vec(), Style::Plate, color);
    }

    fn shape(&mut self, name: &str, track: usize, points: Vec<Vec3>, style: Style, color: &str) {
        if points.len() > 1 && points.iter().all(|p| p.norm().is_finite()) {
            self.shapes.push(Shape {
                name: name.to_string(),
                track,
                points,
                style,
                color: color.to_string(),
            });
        }
    }

    fn thinned(&self, path: &[Vec3]) -> Vec<Vec3> {
        let flat: Vec<Vec2> = path.iter().map(|p| vec2(p.x, p.y)).collect();
        thinned_path(&flat, 5e-4 * self.size)
            .into_iter()
            .map(|p| Vec3::new(p.x, p.y, 0.0))
            .collect()
    }
}

/// The ends of a straight path, drawn out by a length on either side.
fn ends(path: &[Vec3], by: f64) -> Vec<Vec3> {
    let Some(first) = path.first() else { return Vec::new() };
    let far = |from: Vec3| {
        path.iter()
            .copied()
            .max_by(|a, b| (*a - from).norm().total_cmp(&(*b - from).norm()))
            .unwrap_or(from)
    };
    let a = far(*first);
    let b = far(a);
    let out = (b - a) * (by / (b - a).norm().max(f64::MIN_POSITIVE));
    vec![a - out, b + out]
}
