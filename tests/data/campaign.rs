//! Thousands of spoilt inputs on all cores: how many are read, the slowest one, and memory.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Behind its first tenth a campaign needs hardly more memory: what an input takes is given back.
const MOST_GROWTH: u64 = 64 << 20;
/// Other tests of the same process take memory too, so that a small sample is not judged by it.
const MANY: u64 = 20_000;

/// The end of one input.
pub struct One {
    pub read: bool,
    pub time: Duration,
    pub text: String,
}

/// The end of all of them.
#[derive(Default)]
pub struct Tried {
    pub count: u64,
    pub read: u64,
    pub longest: Duration,
    /// The input that took longest.
    pub slowest: String,
    /// Bytes of memory that the process has had at most, and by how much that has grown after the
    /// first tenth; 0 where the system does not tell.
    pub peak: u64,
    pub grown: u64,
    wall: Duration,
}

/// An input that takes longer than this ends the campaign with its number, for it may never come to
/// an end.
const HANGS: Duration = Duration::from_secs(60);

/// Tries inputs by their numbers, each by itself, so that the result does not depend on the number
/// of cores: as many as the variable says, or `few`.
pub fn tried(variable: &str, few: u64, one: impl Fn(u64) -> One + Sync) -> Tried {
    let count = std::env::var(variable).ok().and_then(|n| n.parse().ok()).unwrap_or(few);
    let next = AtomicU64::new(0);
    let all = Mutex::new(Tried { count, ..Tried::default() });
    let begun = Instant::now();
    let early = AtomicU64::new(0);
    let under_way = Mutex::new(BTreeMap::new());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                break;
            }
            under_way.lock().expect("no thread has panicked").insert(number, Instant::now());
            let One { read, time, text } = one(number);
            under_way.lock().expect("no thread has panicked").remove(&number);
            if number == count / 10 {
                early.store(peak(), Ordering::Relaxed);
            }
            let mut all = all.lock().expect("no thread has panicked");
            all.read += u64::from(read);
            if time > all.longest {
                (all.longest, all.slowest) = (time, text);
            }
        }
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        while workers.iter().any(|worker| !worker.is_finished()) {
            std::thread::sleep(Duration::from_millis(20));
            end_where_one_hangs(&under_way);
        }
    });
    let mut all = all.into_inner().expect("no thread has panicked");
    (all.peak, all.wall) = (peak(), begun.elapsed());
    all.grown = all.peak.saturating_sub(early.into_inner());
    all
}

/// A thread cannot be stopped from outside, so that the whole process ends.
fn end_where_one_hangs(under_way: &Mutex<BTreeMap<u64, Instant>>) {
    let under_way = under_way.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((number, _)) = under_way.iter().find(|(_, begun)| begun.elapsed() > HANGS) {
        eprintln!("input number {number} has taken more than {HANGS:?}");
        std::process::exit(101);
    }
}

/// The most memory that the process has had, in bytes.
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok()).unwrap_or(0)
        * 1024
}

impl Tried {
    /// Asserts that no input has taken long, and all of them no more memory than a few.
    pub fn are_bounded(&self) {
        assert!(self.longest.as_secs() < 20, "{self}");
        assert!(self.count < MANY || self.grown < MOST_GROWTH, "{self}");
    }
}

impl fmt::Display for Tried {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tried { count, read, longest, slowest, peak, grown, wall } = self;
        let [peak, grown] = [peak, grown].map(|bytes| bytes >> 20);
        writeln!(
            f,
            "{count} tried in {wall:.1?}, {read} read; {peak} MB at most, {grown} MB of them after a tenth"
        )?;
        write!(
            f,
            "the slowest took {longest:.1?}:\n{}",
            slowest.chars().take(2000).collect::<String>()
        )
    }
}
