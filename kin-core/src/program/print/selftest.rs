//! Prints the self test of a file: numbers that this machine must compute too.

use std::fmt::Write;

use super::c::{Printer, Sample, Symbol, rows};
use super::vector::{Inputs, memory};

/// A list of a sample.
type OfSample = fn(&Sample) -> Vec<f64>;

/// Offsets of a test vector in units of the sizes: irregular, so that no two terms cancel.
fn irregular(k: usize) -> f64 {
    0.03 * ((k as f64 * 0.618_033_988_749_895).fract() + 0.25)
}

impl Printer<'_> {
    /// Prints the body of the self test: first all functions at a place that is no solution, then
    /// positions that the library computed.
    pub(super) fn selftest(&self) -> String {
        let sheet = self.sheet;
        let tape = sheet.tape;
        let (drivers, torn, memory) = self.place();
        let at = |places: &[u32]| -> Vec<f64> {
            places.iter().map(|place| memory[*place as usize]).collect()
        };
        let mut text = String::new();
        let mut tables = |name: &str, numbers: &[f64]| {
            let _ = writeln!(
                text,
                "    static const double {name}[{}] = {{{}}};",
                numbers.len().max(1),
                rows(numbers)
            );
        };
        let order = |k: usize| drivers.iter().map(|own| own[k]).collect::<Vec<f64>>();
        tables("u", &order(0));
        tables("ud", &order(1));
        tables("udd", &order(2));
        tables("y", &torn);
        let guards = tape.guards.concat();
        let mut fields: Vec<(&str, Vec<f64>)> = [
            ("dy", &tape.correction),
            ("left", &tape.left),
            ("q", &tape.values),
            ("dq", &tape.corrections),
            ("qd", &tape.rates),
            ("qdd", &tape.second_rates),
            ("c", &tape.verify),
            ("g", &guards),
        ]
        .into_iter()
        .map(|(name, places)| (name, at(places)))
        .filter(|(_, numbers)| !numbers.is_empty())
        .collect();
        if sheet.is_by_time() {
            let [_, ud, udd] = drivers[0];
            let rates = at(&tape.rates);
            for (name, numbers) in &mut fields {
                for (x, rate) in numbers.iter_mut().zip(&rates) {
                    match *name {
                        "qd" => *x *= ud,
                        "qdd" => *x = ud * ud * *x + udd * rate,
                        _ => {}
                    }
                }
            }
        }
        for (name, numbers) in &fields {
            tables(&format!("of_{name}"), numbers);
        }
        let count = sheet.samples.len();
        let lists: [(&str, OfSample); 6] = [
            ("path_u", |sample| sample.u.clone()),
            ("path_ud", |sample| sample.ud.clone()),
            ("path_udd", |sample| sample.udd.clone()),
            ("path_q", |sample| sample.q.clone()),
            ("path_qd", |sample| sample.qd.clone()),
            ("path_qdd", |sample| sample.qdd.clone()),
        ];
        for (name, of) in lists {
            let all: Vec<f64> = sheet.samples.iter().flat_map(of).collect();
            tables(name, &all);
        }
        text += &self.comparisons(&fields, (torn.len(), count));
        text
    }

    /// Prints the comparisons of the self test.
    fn comparisons(&self, fields: &[(&str, Vec<f64>)], (torn, count): (usize, usize)) -> String {
        let is_free = !self.sheet.free.is_empty();
        let nominal = if is_free { ", &@N@_nominal" } else { "" };
        let mut text = format!(
            "    struct @N@_work k;
    @N@_state s;
    double qd[@N@_COORDINATES], qdd[@N@_COORDINATES];
    int i, j;
    if (@N@_start(&s{nominal}) != @N@_OK || !@N@_agree(s.q, @N@_q0, @N@_COORDINATES, 1e-11)) {{
        return 1;
    }}
    @N@_load(&s, &k);
    for (i = 0; i < @N@_DRIVERS; i++) {{
        k.u[i] = u[i];
        k.ud[i] = ud[i];
        k.udd[i] = udd[i];
    }}
    for (i = 0; i < {torn}; i++) {{
        k.y[i] = y[i];
    }}
    @N@_evaluate(&k);
"
        );
        let mut code = 1;
        for (name, numbers) in fields {
            code += 1;
            let n = numbers.len();
            let _ = writeln!(
                text,
                "    if (!@N@_agree(k.{name}, of_{name}, {n}, 1e-9)) {{\n        return {code};\n    }}"
            );
        }
        let _ = write!(
            text,
            "    for (j = 0; j < {count}; j++) {{
        const int n = @N@_COORDINATES, d = @N@_DRIVERS;
        if (@N@_to(&s, path_u + d * j) != @N@_OK || !@N@_agree(s.q, path_q + n * j, n, 1e-11)) {{
            return {};
        }}
        if (@N@_rates(&s, path_ud + d * j, path_udd + d * j, qd, qdd) != @N@_OK
            || !@N@_agree(qd, path_qd + n * j, n, 1e-9)
            || !@N@_agree(qdd, path_qdd + n * j, n, 1e-8)) {{
            return {};
        }}
    }}
    return 0;",
            code + 1,
            code + 2
        );
        text
    }

    /// Returns a place at which all functions are finite, as near to the start as that needs: the
    /// drivers, the torn coordinates and the memory of the tape.
    fn place(&self) -> (Vec<[f64; 3]>, Vec<f64>, Vec<f64>) {
        let sheet = self.sheet;
        let tape = sheet.tape;
        let mut share = 1.0;
        loop {
            let driver = |(k, own): (usize, &Symbol)| {
                [
                    own.value + share * irregular(k),
                    0.7 + 10.0 * irregular(k),
                    20.0 * irregular(k + 5),
                ]
            };
            let drivers: Vec<[f64; 3]> = sheet.drivers.iter().enumerate().map(driver).collect();
            let coordinate = |(k, column): (usize, &usize)| {
                sheet.coordinates[*column].value + share * sheet.sizes[*column] * irregular(k + 11)
            };
            let torn: Vec<f64> = tape.columns.iter().enumerate().map(coordinate).collect();
            let place = Inputs { drivers: &drivers, torn: &torn, parameters: &sheet.values };
            let memory = memory(tape, sheet.driver_laws, &place);
            let lists = [&tape.correction, &tape.left, &tape.values, &tape.corrections];
            let others = [&tape.rates, &tape.second_rates, &tape.verify];
            let finite = lists
                .into_iter()
                .chain(others)
                .flatten()
                .chain(tape.guards.iter().flatten())
                .all(|place| memory[*place as usize].is_finite());
            if finite || share < 1e-3 {
                return (drivers, torn, memory);
            }
            share *= 0.1;
        }
    }
}
