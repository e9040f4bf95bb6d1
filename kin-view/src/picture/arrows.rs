//! Draws the forces in a picture as straight arrows, with arcs for torques in the plane, and a
//! scale.

use kin::{Vec2, Vec3, vec2};

use super::svg::{Svg, digits, escaped, short};
use super::view::View;
use crate::drawing::{Drawing, Push, round_below};
use crate::scene::Acting;

/// Length and half width of a head, radius of an arc.   \[px\]
const HEAD: [f64; 2] = [9.0, 3.6];
const RADIUS: f64 = 19.0;

/// Arrows and arcs shorter than this are not drawn.   \[px\]
const LEAST: f64 = 2.0;

/// An arc ends before it would meet itself.   \[rad\]
const WHOLE: f64 = 5.6;

/// Where the scale stands, from the left and from the bottom; how long it is at most, and how
/// high.   \[px\]
const CORNER: [f64; 2] = [14.0, 14.0];
const BAR: f64 = 90.0;
const ROW: f64 = 18.0;

/// All arrows at time k, and their scale.
pub(super) fn arrows(drawing: &Drawing, view: &View, k: usize, svg: &mut Svg) {
    for push in &drawing.pushes {
        let foot = drawing.tracks[push.track].frame(k).point(push.local);
        let vector = push.vectors.get(k).copied().unwrap_or(Vec3::zeros());
        let scale = &drawing.scales[usize::from(push.is_torque)];
        if push.is_torque && drawing.planar {
            let angle = vector.z * scale.turn;
            let d = arc(view.point(foot), angle.clamp(-WHOLE, WHOLE));
            drawn(push, d, angle.abs() > WHOLE, svg);
        } else {
            let shown = drawing.shown(push, k);
            let d = straight([foot, foot + shown].map(|p| view.point(p)), push.is_torque);
            drawn(push, d, vector.norm() * scale.length > drawing.longest, svg);
        }
    }
    if !drawing.pushes.is_empty() {
        legend(drawing, view, svg);
    }
}

/// A path, dashed where it is cut.
fn drawn(push: &Push, d: Option<String>, is_cut: bool, svg: &mut Svg) {
    let Some(d) = d else { return };
    let color = color(push.acting);
    let dashed = if is_cut { " stroke-dasharray=\"7 4\"" } else { "" };
    svg.push(&format!(
        "<path d=\"{d}\" fill=\"{color}\" stroke=\"{color}\" stroke-width=\"2\"{dashed}><title>{}</title></path>",
        escaped(&push.name)
    ));
}

/// The colour of what acts.
fn color(acting: Acting) -> &'static str {
    match acting {
        Acting::Joint => "#b00020",
        Acting::Drive => "#1b7f3b",
        Acting::Load => "#1f4fd8",
    }
}

/// A shaft and its head, a second one for a torque.
fn straight([from, to]: [Vec2; 2], two: bool) -> Option<String> {
    let length = (to - from).norm();
    if !(length > LEAST && length.is_finite()) {
        return None;
    }
    let along = (to - from) * (1.0 / length);
    let size = (length / (1.5 * HEAD[0])).min(1.0);
    let neck = to - along * (HEAD[0] * size);
    let second = if two { head(neck, along, size) } else { String::new() };
    Some(format!("M{}L{}{}{second}", at(from), at(neck), head(to, along, size)))
}

/// An arc about a point, counter-clockwise for a positive angle, from below.
fn arc(centre: Vec2, turned: f64) -> Option<String> {
    if !(turned.abs() * RADIUS > LEAST && centre.x.is_finite() && centre.y.is_finite()) {
        return None;
    }
    // Pictures are upside down.
    let place = |angle: f64| centre + vec2(angle.sin(), angle.cos()) * RADIUS;
    let size = (turned.abs() * RADIUS / (1.5 * HEAD[0])).min(1.0);
    let from = place(0.0);
    let to = place(turned);
    let back = place(turned - turned.signum() * HEAD[0] * size / RADIUS);
    let along = (to - back) * (1.0 / (to - back).norm());
    let large = u8::from(turned.abs() > std::f64::consts::PI);
    let sweep = u8::from(turned < 0.0);
    let run = |sweep: u8, to: Vec2| format!("A{RADIUS} {RADIUS} 0 {large} {sweep} {}", at(to));
    // The way back along the same arc leaves nothing between them to be filled.
    Some(format!(
        "M{}{}{}{}",
        at(from),
        run(sweep, back),
        run(1 - sweep, from),
        head(to, along, size)
    ))
}

/// A triangle with its tip there.
fn head(tip: Vec2, along: Vec2, size: f64) -> String {
    let back = tip - along * (HEAD[0] * size);
    let side = vec2(-along.y, along.x) * (HEAD[1] * size);
    format!("M{}L{}L{}Z", at(tip), at(back + side), at(back - side))
}

fn at(p: Vec2) -> String {
    format!("{} {}", short(p.x), short(p.y))
}

/// The height that the scale takes.   \[px\]
pub(super) fn room(drawing: &Drawing) -> f64 {
    ROW * drawing.scales.iter().filter(|scale| scale.length > 0.0).count() as f64
}

/// A bar for a round number of newtons, and what half a turn of an arc stands for.
fn legend(drawing: &Drawing, view: &View, svg: &mut Svg) {
    let mut y = view.height - CORNER[1];
    for (scale, is_torque) in drawing.scales.iter().zip([false, true]).rev() {
        if scale.length == 0.0 {
            continue;
        }
        if is_torque && drawing.planar {
            let half = std::f64::consts::PI / scale.turn;
            svg.note(
                vec2(CORNER[0], y + 4.0),
                &format!("half a turn: {} {}", digits(half), scale.unit),
            );
        } else {
            let pixels = scale.length * view.scale;
            let number = round_below(BAR / pixels);
            let ends = [0.0, number * pixels].map(|x| vec2(CORNER[0] + x, y));
            let d = straight(ends, is_torque).unwrap_or_default();
            svg.push(&format!(
                "<path d=\"{d}\" fill=\"#444444\" stroke=\"#444444\" stroke-width=\"2\"/>"
            ));
            svg.note(ends[1] + vec2(7.0, 4.0), &format!("{} {}", digits(number), scale.unit));
        }
        y -= ROW;
    }
}
