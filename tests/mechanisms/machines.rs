//! Six machines, as the examples build them, against calculations that know nothing of constraints:
//! triangles, circles and spheres that meet, closed forms.

use kin::data::Registry;
use kin::nalgebra;
use kin::prelude::*;

use crate::engines::Engines;
use crate::own;
use crate::worst;

/// The motion of an example's mechanism.
fn example(name: &str, to: f64, times: usize) -> Motion {
    let path = format!("{}/tests/data/examples/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mechanism =
        Mechanism::read_json(path, &Registry::new().with::<own::geneva>()).expect("reads back");
    mechanism.build().expect("builds").run_both(linspace(0.0, to, times)).expect("runs")
}

fn planar(motion: &Motion, name: &str) -> PlanarBody {
    motion.planar_named(name).expect("a planar body")
}

fn spatial_body(motion: &Motion, name: &str) -> SpatialBody {
    motion.spatial_named(name).expect("a spatial body")
}

/// p turned about the axis through o along h (Rodrigues).
fn turned(p: Vec3, o: Vec3, h: Vec3, angle: f64) -> Vec3 {
    let h = h / h.norm();
    let v = p - o;
    let (sin, cos) = angle.sin_cos();
    o + v * cos + h.cross(v) * sin + h * (h.dot(v) * (1.0 - cos))
}

/// The point with these distances from three others, on the side of their plane on which `like` is
/// of the plane of `from`.
fn from_three(p: [Vec3; 3], from: [Vec3; 3], like: Vec3) -> Vec3 {
    let r = from.map(|q| (like - q).norm());
    let frame = |p: [Vec3; 3]| {
        let x = (p[1] - p[0]) / (p[1] - p[0]).norm();
        let across = (p[2] - p[0]) - x * (p[2] - p[0]).dot(x);
        let y = across / across.norm();
        (x, y, x.cross(y))
    };
    let (ex, ey, ez) = frame(p);
    let d = (p[1] - p[0]).norm();
    let i = (p[2] - p[0]).dot(ex);
    let j = (p[2] - p[0]).dot(ey);
    let x = (r[0] * r[0] - r[1] * r[1] + d * d) / (2.0 * d);
    let y = (r[0] * r[0] - r[2] * r[2] + i * i + j * j) / (2.0 * j) - i * x / j;
    let height = (r[0] * r[0] - x * x - y * y).max(0.0).sqrt();
    let side = (like - from[0]).dot(frame(from).2).signum();
    p[0] + ex * x + ey * y + ez * (side * height)
}

/// The lower ball goes on a circle, the upper one on another at a distance from it, the tie rod's
/// ball at distances from both and from the rack, and the hub with the upright: circles and spheres
/// that meet, for the wheel travel and the rack of each time.
#[test]
fn double_wishbone_is_circles_and_spheres_that_meet() {
    let motion = example("17_double_wishbone", 8.0, 161);
    let rack = motion.coordinate(spatial_body(&motion, "rack").y()).unwrap().value;
    for (name, side) in [("left", 1.0), ("right", -1.0)] {
        let at = |x: f64, y: f64, z: f64| vec3(x, side * y, z);
        let [lower_front, lower_rear, lower] =
            [at(150.0, 350.0, 190.0), at(-170.0, 350.0, 200.0), at(5.0, 725.0, 175.0)];
        let [upper_front, upper_rear, upper] =
            [at(110.0, 430.0, 470.0), at(-130.0, 430.0, 455.0), at(-20.0, 680.0, 500.0)];
        let [inner, outer, hub] =
            [at(-140.0, 390.0, 255.0), at(-125.0, 705.0, 252.0), at(0.0, 780.0, 320.0)];
        let tip = hub + vec3(0.0, side, 0.0);
        let pose = |angle: f64, rack: f64| {
            let l = turned(lower, lower_front, lower_rear - lower_front, angle);
            // The upper ball at the angle b: |o + v cos b + w sin b + c − l|² = D² is A cos b + B
            // sin b = C.
            let h = (upper_rear - upper_front) / (upper_rear - upper_front).norm();
            let along = h * h.dot(upper - upper_front);
            let v = upper - upper_front - along;
            let w = h.cross(v);
            let m = l - upper_front - along;
            let a = 2.0 * v.dot(m);
            let b = 2.0 * w.dot(m);
            let c = m.norm_squared() + v.norm_squared() - (upper - lower).norm_squared();
            let middle = b.atan2(a);
            let half = (c / a.hypot(b)).clamp(-1.0, 1.0).acos();
            let u =
                [middle - half, middle + half].map(|angle| turned(upper, upper_front, h, angle));
            let u = if (u[0] - upper).norm() < (u[1] - upper).norm() { u[0] } else { u[1] };
            let o = from_three([l, u, inner + vec3(0.0, rack, 0.0)], [lower, upper, inner], outer);
            [hub, tip].map(|p| from_three([l, u, o], [lower, upper, outer], p))
        };
        let body = spatial_body(&motion, &format!("{name} upright"));
        let wheel = motion.point(body, hub).unwrap();
        let spindle = motion.point(body, tip).unwrap();
        let error = worst(&motion, |k, _| {
            let mut low = -0.4;
            let mut high = 0.4;
            let height = |angle: f64| pose(angle, rack.values()[k])[0].z - wheel.r()[k].z;
            let rises = height(high) > height(low);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (height(middle) > 0.0) == rises { high = middle } else { low = middle }
            }
            let [hub, tip] = pose(low, rack.values()[k]);
            (wheel.r()[k] - hub).norm() + (spindle.r()[k] - tip).norm()
        });
        assert!(error < 1e-8, "{name}: the wheel is off by {error:e} mm");
    }
    // The motion of the wheel: at full bump it leans inwards, and toe hardly changes.
    let body = spatial_body(&motion, "left upright");
    let direction = |k: usize| {
        let r = |y: f64| motion.point(body, vec3(0.0, y, 320.0)).unwrap().r()[k];
        r(781.0) - r(780.0)
    };
    let bump = direction(20);
    assert!(
        (-bump.z.asin().to_degrees() + 2.41).abs() < 0.05,
        "camber at 60 mm: {}",
        -bump.z.asin().to_degrees()
    );
    assert!(bump.x.atan2(bump.y).to_degrees().abs() < 0.2);
}

/// The angle at A of a triangle with the sides b and c at A and a against it.
fn angle_at(a: f64, b: f64, c: f64) -> f64 {
    ((b * b + c * c - a * a) / (2.0 * b * c)).acos()
}

fn arg(p: Vec2) -> f64 {
    p.y.atan2(p.x)
}

/// A difference of angles, but for whole turns.
fn between(a: f64, b: f64) -> f64 {
    (a - b + PI).rem_euclid(TAU) - PI
}

/// Boom, stick and lever by the triangles of their cylinders, the bucket by that of its rod.
#[test]
fn excavator_is_four_triangles() {
    let motion = example("18_excavator", 12.0, 401);
    let [boom, stick, bucket, lever] = ["boom", "stick", "bucket", "lever"]
        .map(|name| motion.coordinate(planar(&motion, name).theta()).unwrap().value);
    // Cylinders: moves of three seconds with the polynomial 10 u³ − 15 u⁴ + 6 u⁵.
    let length = |lengths: [f64; 5], t: f64| {
        let k = ((t / 3.0) as usize).min(3);
        let u = t / 3.0 - k as f64;
        lengths[k] + (lengths[k + 1] - lengths[k]) * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
    };
    let error = worst(&motion, |k, t| {
        let d = vec2(0.55, -0.65);
        let eye = vec2(2.35, 0.55);
        let exact_boom = arg(d)
            + angle_at(length([2.67, 2.27, 2.3, 2.7, 2.67], t), d.norm(), eye.norm())
            - arg(eye);
        let d = vec2(2.6 - 5.4, 1.25);
        let eye = vec2(-0.75, 0.25);
        let beside = arg(d)
            - angle_at(length([2.85, 2.85, 3.45, 3.45, 2.85], t), d.norm(), eye.norm())
            - arg(eye);
        let d = vec2(-0.1 - 2.3, 0.6 - 0.05);
        let arm = arg(d) - angle_at(length([2.45, 2.45, 2.85, 2.9, 2.45], t), d.norm(), 0.55);
        let d = vec2(2.3 - 2.7, 0.05) + vec2(arm.cos(), arm.sin()) * 0.55;
        let eye = vec2(0.12, 0.38);
        let curl = arg(d) - angle_at(0.5, d.norm(), eye.norm()) - arg(eye);
        let off = [
            between(boom.values()[k], exact_boom),
            between(stick.values()[k] - boom.values()[k], beside),
            between(lever.values()[k] - stick.values()[k], arm),
            between(bucket.values()[k] - stick.values()[k], curl),
        ];
        off.iter().fold(0.0_f64, |m, x| m.max(x.abs()))
    });
    assert!(error < 1e-12, "angles are off by {error:e}");
}

/// Each motor by E cos φ + F sin φ + G = 0 (the closed form of the inverse problem), and the plate
/// level, which nothing tells.
#[test]
fn delta_robot_has_the_motor_angles_of_the_closed_form() {
    let base = 200.0;
    let plate = 60.0;
    let arm = 250.0;
    let forearm = 560.0;
    let motion = example("19_delta_robot", 2.0, 401);
    let body = spatial_body(&motion, "plate");
    let tool = motion.point(body, vec3(0.0, 0.0, 0.0)).unwrap();
    let error = worst(&motion, |k, _| {
        let p = tool.r()[k];
        let off = (0..3).map(|number| {
            let azimuth = TAU / 3.0 * f64::from(number);
            let (sin, cos) = azimuth.sin_cos();
            let x = cos * p.x + sin * p.y + plate - base;
            let y = cos * p.y - sin * p.x;
            let e = -2.0 * x * arm;
            let f = 2.0 * p.z * arm;
            let g = x * x + y * y + p.z * p.z + arm * arm - forearm * forearm;
            let half = (-g / e.hypot(f)).acos();
            // Of the two solutions the elbow outside.
            let [a, b] = [-half, half].map(|half| f.atan2(e) + half);
            let phi = if a.cos() > b.cos() { a } else { b };
            let link = spatial_body(&motion, &format!("arm {}", number + 1));
            let elbow = motion.point(link, vec3(0.5 * arm, 0.0, 0.0)).unwrap().r()[k];
            let out = base + arm * phi.cos();
            (elbow - vec3(out * cos, out * sin, -arm * phi.sin())).norm()
        });
        off.fold(0.0, f64::max)
    });
    assert!(error < 1e-9, "elbows are off by {error:e} mm");
    let tilt = worst(&motion, |k, _| {
        (motion.point(body, vec3(0.0, 0.0, 100.0)).unwrap().r()[k]
            - tool.r()[k]
            - vec3(0.0, 0.0, 100.0))
        .norm()
    });
    assert!(tilt < 1e-9, "the plate is not level by {tilt:e} mm");
    // Half of the way up, across and down: the tool is where the path says.
    let middle = tool.r()[100];
    assert!((middle - vec3(0.0, 0.0, -460.0)).norm() < 1e-9, "{middle:?}");
}

/// β = atan2(a sin α, c − a cos α) while the pin is in a slot, and rest at each of six stations.
#[test]
fn geneva_wheel_goes_by_stations_and_the_closed_form() {
    let a = 40.0;
    let stations = 6.0;
    let step = TAU / stations;
    let c = a / (0.5 * step).sin();
    let motion = example("20_geneva_drive", 12.0, 2401);
    let wheel = motion.coordinate(planar(&motion, "wheel").theta()).unwrap();
    let mut at_rest = 0;
    let error = worst(&motion, |k, t| {
        let driver = PI + PI * t;
        let turns = (driver / TAU).round();
        let alpha = driver - TAU * turns;
        let omega = PI;
        let angle = wheel.value.values()[k];
        let rate = wheel.rate.values()[k];
        if alpha.abs() < 0.5 * PI - 0.5 * step - 1e-9 {
            let (sin, cos) = alpha.sin_cos();
            let exact = -step * turns - (a * sin).atan2(c - a * cos);
            let exact_rate = -omega * a * (c * cos - a) / (a * a + c * c - 2.0 * a * c * cos);
            (angle - exact).abs() + (rate - exact_rate).abs()
        } else if alpha.abs() > 0.5 * PI - 0.5 * step + 1e-9 {
            at_rest += 1;
            let station = if alpha > 0.0 { turns + 0.5 } else { turns - 0.5 };
            (angle + step * station).abs() + rate.abs()
        } else {
            0.0
        }
    });
    assert!(error < 1e-12, "off by {error:e}");
    let share = f64::from(at_rest) / motion.len() as f64;
    assert!((share - 2.0 / 3.0).abs() < 0.01, "it rests for two thirds of the time, not {share}");
    let turned = wheel.value.values()[0] - wheel.value.values()[2400];
    assert!((turned - TAU).abs() < 1e-12, "six stations are a turn, not {turned}");
    let slowest = -wheel.rate.min() / PI;
    assert!(
        (slowest - a / (c - a)).abs() < 1e-12,
        "at most a/(c − a) of the driver's speed: {slowest}"
    );
}

/// The periodic cubic spline through values at even steps, by its moments M: M_(k−1) + 4 M_k +
/// M_(k+1) = 6 (y_(k−1) − 2 y_k + y_(k+1))/h².
fn spline(y: &[f64], h: f64) -> impl Fn(f64) -> (f64, f64) {
    let n = y.len();
    let mut system = nalgebra::DMatrix::zeros(n, n);
    let mut right = nalgebra::DVector::zeros(n);
    for k in 0..n {
        let before = (k + n - 1) % n;
        let after = (k + 1) % n;
        system[(k, k)] = 4.0;
        (system[(k, before)], system[(k, after)]) = (1.0, 1.0);
        right[k] = 6.0 * (y[before] - 2.0 * y[k] + y[after]) / (h * h);
    }
    let moments = system.lu().solve(&right).expect("regular");
    let y = y.to_vec();
    move |x: f64| {
        let x = x.rem_euclid(h * n as f64);
        let k = ((x / h) as usize).min(n - 1);
        let m0 = moments[k];
        let m1 = moments[(k + 1) % n];
        let y0 = y[k];
        let y1 = y[(k + 1) % n];
        let u = x - h * k as f64;
        let v = h * (k + 1) as f64 - x;
        let a = y0 / h - m0 * h / 6.0;
        let b = y1 / h - m1 * h / 6.0;
        let value = m0 * v * v * v / (6.0 * h) + m1 * u * u * u / (6.0 * h) + a * v + b * u;
        (value, -m0 * v * v / (2.0 * h) + m1 * u * u / (2.0 * h) - a + b)
    }
}

/// The roller's centre is where the parallel curve of the edge meets the circle of the lever.
#[test]
fn cam_with_roller_is_a_parallel_curve_that_meets_a_circle() {
    let table = [
        40.0, 40.0, 40.3, 42.1, 45.9, 50.8, 55.2, 58.4, 59.8, 60.0, 60.0, 59.6, 57.9, 54.8, 51.2,
        47.8, 44.9, 42.7, 41.2, 40.4, 40.1, 40.0, 40.0, 40.0,
    ];
    let edge = spline(&table, deg(15.0));
    let roller = 12.0;
    let lever = 95.0;
    let pivot = vec2(-90.0, 62.0);
    let motion = example("21_cam_with_roller", 2.0, 121);
    let centre = motion.point(planar(&motion, "lever"), vec2(0.5 * lever, 0.0)).unwrap();
    let error = worst(&motion, |k, t| {
        let theta = -PI * t;
        let at = |phi: f64| {
            let (rho, slope) = edge(phi);
            let e = vec2(phi.cos(), phi.sin());
            let across = vec2(-phi.sin(), phi.cos());
            let normal = (e * rho - across * slope) / rho.hypot(slope);
            let seen = e * rho + normal * roller;
            let (sin, cos) = theta.sin_cos();
            vec2(cos * seen.x - sin * seen.y, sin * seen.x + cos * seen.y)
        };
        let gap = |phi: f64| (at(phi) - pivot).norm() - lever;
        // Of all places where they meet, the highest.
        let places = (0..360)
            .map(|k| (deg(f64::from(k)), deg(f64::from(k + 1))))
            .filter(|(from, to)| gap(*from) * gap(*to) <= 0.0);
        let met = places.map(|(mut low, mut high)| {
            let rises = gap(high) > gap(low);
            for _ in 0..55 {
                let middle = 0.5 * (low + high);
                if (gap(middle) > 0.0) == rises { high = middle } else { low = middle }
            }
            at(low)
        });
        let exact = met.max_by(|a, b| a.y.total_cmp(&b.y)).expect("they meet");
        (centre.r()[k] - exact).norm()
    });
    assert!(error < 1e-9, "the roller is off by {error:e} mm");
}

/// Willis: z_s (ω_s − ω_c) + z_r (ω_r − ω_c) = 0; and the pitch points, at which wheels that mesh
/// have one velocity.
#[test]
fn planetary_train_obeys_willis_and_its_pitch_points_have_one_velocity() {
    let z_sun = 30.0;
    let z_ring = 72.0;
    let r_sun = 30.0;
    let r_planet = 21.0;
    let r_ring = 72.0;
    let motion = example("22_planetary_train", 8.0, 401);
    let [sun, ring, carrier] = ["sun", "ring", "carrier"]
        .map(|name| motion.coordinate(planar(&motion, name).theta()).unwrap());
    let error = worst(&motion, |k, _| {
        let equation = |of: fn(&kin::results::Quantity) -> &Series| {
            let [s, r, c] = [&sun, &ring, &carrier].map(|wheel| of(wheel).values()[k]);
            (z_sun * (s - c) + z_ring * (r - c)) / (z_sun + z_ring)
        };
        let [angle, rate, second] =
            [equation(|q| &q.value), equation(|q| &q.rate), equation(|q| &q.second_rate)];
        angle.abs() + rate.abs() + second.abs()
    });
    assert!(error < 1e-12, "Willis is off by {error:e}");
    for number in 0..3 {
        let place = TAU / 3.0 * f64::from(number);
        let planet = planar(&motion, &format!("planet {}", number + 1));
        let turn = motion.coordinate(planet.theta()).unwrap();
        let axle = motion.point(planet, vec2(0.0, 0.0)).unwrap();
        let slip = worst(&motion, |k, _| {
            let line = carrier.value.values()[k] + place;
            let across = vec2(-line.sin(), line.cos());
            let [w_sun, w_ring, w] = [&sun, &ring, &turn].map(|wheel| wheel.rate.values()[k]);
            // Of the planet at the sun and at the ring, less that of the sun and of the ring there.
            let inner = axle.v()[k] - across * (r_planet * w) - across * (r_sun * w_sun);
            let outer = axle.v()[k] + across * (r_planet * w) - across * (r_ring * w_ring);
            inner.norm() + outer.norm()
        });
        assert!(slip < 1e-11, "planet {}: the pitch points slip at {slip:e} mm/s", number + 1);
    }
}
