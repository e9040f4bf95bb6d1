//! Timing routes side by side, and printing figures.

use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};

/// One figure, printed as a JSON line.
pub struct Figure {
    workload: String,
    peer: String,
    metric: String,
    value: f64,
}

impl Figure {
    pub fn new(
        workload: impl Into<String>,
        peer: impl Into<String>,
        metric: impl Into<String>,
        value: f64,
    ) -> Self {
        Figure { workload: workload.into(), peer: peer.into(), metric: metric.into(), value }
    }

    pub fn print(&self) {
        let Figure { workload, peer, metric, value } = self;
        println!(
            "{}",
            serde_json::json!({ "workload": workload, "peer": peer, "metric": metric, "value": value })
        );
    }
}

/// CPU time of this thread: on shared cores it is less noisy than the clock on the wall.
pub fn cpu() -> Duration {
    duration(ClockId::ThreadCPUTime)
}

/// CPU time of all threads.
pub fn cpu_of_all_threads() -> Duration {
    duration(ClockId::ProcessCPUTime)
}

fn duration(clock: ClockId) -> Duration {
    let time = clock_gettime(clock);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// One way to do the work.
pub struct Contestant<'a> {
    pub peer: &'static str,
    pub run: Box<dyn FnMut() + 'a>,
}

/// The findings of a race about one contestant.
pub struct Result {
    pub peer: &'static str,
    /// Median time of one run.   \[ns\]
    pub nanoseconds: f64,
    /// Median of the ratios to the contestant `hand`, round by round.
    pub ratio: f64,
}

/// Runs all contestants in turn, for about `budget` but at least five rounds, and takes medians.
/// One called `hand` is the measure.
pub fn race(contestants: &mut [Contestant<'_>], budget: Duration) -> Vec<Result> {
    // Runs of less than 200 µs are repeated, so that reading the clock does not count.
    let repeats: Vec<u32> =
        contestants.iter_mut().map(|c| (2e5 / time(c, 1)).clamp(1.0, 1000.0) as u32).collect();
    let mut rounds: Vec<Vec<f64>> = Vec::new();
    let start = cpu();
    while rounds.len() < 5 || (cpu() - start < budget && rounds.len() < 1001) {
        rounds.push(
            contestants.iter_mut().zip(&repeats).map(|(c, repeats)| time(c, *repeats)).collect(),
        );
    }
    let hand = contestants.iter().position(|c| c.peer == "hand").unwrap_or(0);
    let column = |k: usize, unit: &dyn Fn(&[f64]) -> f64| {
        median(rounds.iter().map(|round| round[k] / unit(round)).collect())
    };
    let result = |(k, c): (usize, &Contestant<'_>)| Result {
        peer: c.peer,
        nanoseconds: column(k, &|_| 1.0),
        ratio: column(k, &|round| round[hand]),
    };
    contestants.iter().enumerate().map(result).collect()
}

fn time(contestant: &mut Contestant<'_>, repeats: u32) -> f64 {
    let start = cpu();
    (0..repeats).for_each(|_| (contestant.run)());
    (cpu() - start).as_nanos().max(1) as f64 / f64::from(repeats)
}

pub fn median(mut values: Vec<f64>) -> f64 {
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
