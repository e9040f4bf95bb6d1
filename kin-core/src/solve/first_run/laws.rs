//! Finds the numbers of a law that are angles or angular velocities, if the law is an angle.

use crate::law::Law;

/// The meaning of a number of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Of the law's own unit: a constant, an amplitude, a value of a table.
    Value,
    /// Of that unit for each unit of the argument: the slope of a ramp.
    Rate,
    /// An angle, whatever the law's unit is: the phase of a sine.
    Phase,
    /// An angle for each unit of the argument: ω of a sine.
    Frequency,
}

/// Shows each number whose role is known, by the name that [`Law::parameters`] gives it, with the
/// innermost law that has it. Laws that are scaled or multiplied are left out: a table of degrees
/// is right if the law multiplies it by π/180. Of f(g(x)) the values of f count, not its slopes.
pub(super) fn each(law: &Law, visit: &mut dyn FnMut(&str, Role, f64, &Law)) {
    walk(law, "", visit);
}

fn walk(law: &Law, before: &str, visit: &mut dyn FnMut(&str, Role, f64, &Law)) {
    let adds = match law.kind() {
        "sum" | "sequence" | "periodic" => true,
        "multiple" => factor(law).abs() == 1.0,
        _ => false,
    };
    let parts = law.parts();
    if adds {
        parts.iter().for_each(|(name, part)| walk(part, &format!("{before}{name}."), visit));
    } else if law.kind() == "composed" {
        let outer = parts.iter().filter(|(name, _)| name == "outer");
        outer.for_each(|(name, part)| {
            walk(part, &format!("{before}{name}."), &mut |name, role, value, law| {
                if matches!(role, Role::Value | Role::Phase) {
                    visit(name, role, value, law);
                }
            });
        });
    } else if parts.is_empty() {
        law.parameters(&mut |name, value| {
            if let Some(role) = role(name) {
                visit(&format!("{before}{name}"), role, value, law);
            }
        });
    }
}

fn factor(law: &Law) -> f64 {
    let mut factor = f64::NAN;
    law.parameters(&mut |name, value| {
        if name == "factor" {
            factor = value;
        }
    });
    factor
}

/// The role of a number of a law of the library, by its name: the laws use the same names for the
/// same things.
fn role(name: &str) -> Option<Role> {
    match name {
        "c" | "c[0]" | "f0" | "mean" | "amplitude" | "height" | "distance" => Some(Role::Value),
        "rate" | "c[1]" | "speed" => Some(Role::Rate),
        "phase" => Some(Role::Phase),
        "omega" => Some(Role::Frequency),
        _ if ["a[", "b[", "y["].iter().any(|list| name.starts_with(list)) => Some(Role::Value),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Ends;

    fn roles(law: &Law) -> Vec<(String, Role, f64)> {
        let mut all = Vec::new();
        each(law, &mut |name, role, value, _| all.push((name.to_string(), role, value)));
        all
    }

    #[test]
    fn numbers_of_laws_have_roles_unless_something_scales_them() {
        let of = |name: &str, role, value| (name.to_string(), role, value);
        assert_eq!(roles(&Law::ramp(3.0)), [of("rate", Role::Rate, 3.0)]);
        assert_eq!(
            roles(&(Law::constant(2.0) - Law::sine(4.0, 5.0, 6.0))),
            [
                of("first.c", Role::Value, 2.0),
                of("second.law.amplitude", Role::Value, 4.0),
                of("second.law.omega", Role::Frequency, 5.0),
                of("second.law.phase", Role::Phase, 6.0),
            ]
        );
        let rise = Law::sequence(0.0, [(2.0, Law::cycloidal(7.0, 2.0))]);
        assert_eq!(roles(&rise), [of("part[0].law.height", Role::Value, 7.0)]);
        let table = Law::spline(&[(0.0, 30.0), (1.0, 60.0)], Ends::Natural);
        assert_eq!(roles(&table).len(), 2);
        for scaled in [table.clone() * 0.1, table.clone() * Law::ramp(1.0)] {
            assert_eq!(roles(&scaled), []);
        }
        assert_eq!(roles(&table.compose(&Law::ramp(360.0))).len(), 2);
        assert_eq!(roles(&Law::ramp(360.0).compose(&Law::ramp(0.1))), []);
    }
}
