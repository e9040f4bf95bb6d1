//! Timing two routes side by side, and printing figures.

use std::time::Instant;

/// One figure, printed as a JSON line.
pub struct Figure {
    workload: String,
    peer: String,
    metric: String,
    value: f64,
}

impl Figure {
    pub fn new(workload: impl Into<String>, peer: impl Into<String>, metric: impl Into<String>, value: f64) -> Self {
        Figure { workload: workload.into(), peer: peer.into(), metric: metric.into(), value }
    }

    pub fn print(&self) {
        let Figure { workload, peer, metric, value } = self;
        println!("{}", serde_json::json!({ "workload": workload, "peer": peer, "metric": metric, "value": value }));
    }
}

/// Medians of two interleaved routes, and of their ratio round by round.
pub struct Comparison {
    ours: f64,
    theirs: f64,
    ratio: f64,
}

impl Comparison {
    pub fn figures(&self, workload: &str, metric: &str) -> Vec<Figure> {
        eprintln!("{workload}: kin {:.1} ns, by hand {:.1} ns, ratio {:.3}", self.ours, self.theirs, self.ratio);
        vec![
            Figure::new(workload, "kin", metric, self.ours),
            Figure::new(workload, "hand", metric, self.theirs),
            Figure::new(workload, "kin", "ratio_to_hand", self.ratio),
        ]
    }
}

/// Times `ours` and `theirs` in turn, each run doing `count` units of work; ns a unit.
pub fn compare(count: usize, mut ours: impl FnMut(), mut theirs: impl FnMut()) -> Comparison {
    const ROUNDS: usize = 301;
    (0..20).for_each(|_| {
        ours();
        theirs();
    });
    let mut rows: Vec<(f64, f64)> = (0..ROUNDS).map(|_| (time(&mut ours, count), time(&mut theirs, count))).collect();
    let ratio = median(rows.iter().map(|(a, b)| a / b).collect());
    let theirs = median(rows.iter().map(|row| row.1).collect());
    let ours = median(rows.drain(..).map(|row| row.0).collect());
    Comparison { ours, theirs, ratio }
}

fn time(run: &mut impl FnMut(), count: usize) -> f64 {
    const RUNS: u32 = 8;
    let start = Instant::now();
    (0..RUNS).for_each(|_| run());
    start.elapsed().as_nanos() as f64 / f64::from(RUNS) / count as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The generator of the workloads' random numbers.
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}
