//! W4: the driven serial chain. One pass from the ground outwards solves it.

use super::largest;
use crate::sweep::Table;

/// Half the length of a link.
const HALF: f64 = 0.5;

/// One link's half as a vector, its two rows for the pin and one for the driver, and the driver's
/// law with two derivatives.
#[derive(Clone, Copy, Default)]
struct Link {
    e: [f64; 2],
    c: [f64; 3],
    law: [f64; 3],
}

/// φ_i and its derivatives at time t, i from 0.
#[inline(always)]
pub fn law(i: usize, t: f64) -> [f64; 3] {
    let (s, c) = (t + 0.1 * i as f64).sin_cos();
    [0.3 * s, 0.3 * c, -0.3 * s]
}

/// The exact state (x, y, θ and their derivatives) of every link at time t.
pub fn exact(links: usize, t: f64) -> [Vec<f64>; 3] {
    let mut all = [(); 3].map(|()| Vec::with_capacity(3 * links));
    let mut theta = [0.0; 3];
    let mut end = [[0.0; 2]; 3];
    for i in 0..links {
        theta.iter_mut().zip(law(i, t)).for_each(|(sum, x)| *sum += x);
        let s = HALF * theta[0].sin();
        let c = HALF * theta[0].cos();
        let w2 = theta[1] * theta[1];
        let half = [
            [c, s],
            [-s * theta[1], c * theta[1]],
            [-s * theta[2] - c * w2, c * theta[2] - s * w2],
        ];
        for k in 0..3 {
            all[k].extend([end[k][0] + half[k][0], end[k][1] + half[k][1], theta[k]]);
            end[k] = [end[k][0] + 2.0 * half[k][0], end[k][1] + 2.0 * half[k][1]];
        }
    }
    all
}

/// From the state at t = 0, which is made once and not timed, as the library's is.
pub fn run([q, qd, qdd]: &[Vec<f64>; 3], steps: usize, dt: f64) -> Table {
    let mut q = q.clone();
    let mut qd = qd.clone();
    let mut qdd = qdd.clone();
    let links = q.len() / 3;
    let mut chain = vec![Link::default(); links];
    let mut table = Table::new(3 * links, steps);
    for k in 0..steps {
        set_time(&mut chain, k as f64 * dt);
        let mut left = 50;
        while residual(&mut chain, &q) >= 1e-10 && left > 0 {
            correct(&chain, &mut q);
            left -= 1;
        }
        table.iterations += 50 - left;
        velocity(&chain, &mut qd);
        acceleration(&chain, &qd, &mut qdd);
        table.push(&q, &qd, &qdd);
    }
    table
}

/// The laws at time t.
fn set_time(chain: &mut [Link], t: f64) {
    chain.iter_mut().enumerate().for_each(|(i, link)| link.law = law(i, t));
}

/// C; gives max |C_i|.
fn residual(chain: &mut [Link], q: &[f64]) -> f64 {
    // Three maxima, so that the comparisons of one link do not wait for one another.
    let mut worst = [0.0; 3];
    let mut end = [0.0; 2];
    let mut before = 0.0;
    for (link, [x, y, theta]) in chain.iter_mut().zip(q.as_chunks().0) {
        let (s, c) = theta.sin_cos();
        let e = [HALF * c, HALF * s];
        link.e = e;
        link.c = [end[0] - x + e[0], end[1] - y + e[1], theta - before - link.law[0]];
        end = [x + e[0], y + e[1]];
        before = *theta;
        worst
            .iter_mut()
            .zip(link.c)
            .for_each(|(m, c)| *m = if c.abs() > *m { c.abs() } else { *m });
    }
    largest(&worst)
}

/// q += Δq with C_q Δq = −C. Here and below one addition a link waits for the link before.
fn correct(chain: &[Link], q: &mut [f64]) {
    let mut end = [0.0; 2];
    let mut turn = 0.0;
    for (link, [x, y, theta]) in chain.iter().zip(q.as_chunks_mut().0) {
        turn -= link.c[2];
        let v = [-link.e[1] * turn, link.e[0] * turn];
        let half = [v[0] + link.c[0], v[1] + link.c[1]];
        (*x, *y, *theta) = (*x + (end[0] + half[0]), *y + (end[1] + half[1]), *theta + turn);
        end = [end[0] + (half[0] + v[0]), end[1] + (half[1] + v[1])];
    }
}

/// q̇ from C_q q̇ = −C_t.
fn velocity(chain: &[Link], qd: &mut [f64]) {
    let mut end = [0.0; 2];
    let mut turn = 0.0;
    for (link, rates) in chain.iter().zip(qd.as_chunks_mut::<3>().0) {
        turn += link.law[1];
        let v = [-link.e[1] * turn, link.e[0] * turn];
        *rates = [end[0] + v[0], end[1] + v[1], turn];
        end = [end[0] + 2.0 * v[0], end[1] + 2.0 * v[1]];
    }
}

/// q̈ from C_q q̈ = Q_d.
fn acceleration(chain: &[Link], qd: &[f64], qdd: &mut [f64]) {
    let mut end = [0.0; 2];
    let mut turn = 0.0;
    for ((link, [_, _, w]), rates) in
        chain.iter().zip(qd.as_chunks().0).zip(qdd.as_chunks_mut::<3>().0)
    {
        turn += link.law[2];
        let w2 = w * w;
        let v = [-link.e[1] * turn - w2 * link.e[0], link.e[0] * turn - w2 * link.e[1]];
        *rates = [end[0] + v[0], end[1] + v[1], turn];
        end = [end[0] + 2.0 * v[0], end[1] + 2.0 * v[1]];
    }
}
