//! Points of bodies and values of parameters as text.

use std::str::FromStr;

use crate::times::number;

/// `NAME=BODY:X,Y` or `NAME=BODY:X,Y,Z`: a point that is fixed in a body.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    pub name: String,
    pub body: String,
    pub local: Vec<f64>,
}

impl FromStr for NamedPoint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "write NAME=BODY:X,Y, such as P=coupler:0.2,1.4; a point in space needs Z too";
        let (name, rest) = text.split_once('=').ok_or(form)?;
        let (body, local) = rest.rsplit_once(':').ok_or(form)?;
        let local = local.split(',').map(number).collect::<Result<Vec<f64>, String>>();
        let local = local.map_err(|reason| format!("the point of `{body}`: {reason}"))?;
        if name.is_empty() || body.is_empty() || !matches!(local.len(), 2 | 3) {
            return Err(form.to_string());
        }
        Ok(NamedPoint { name: name.to_string(), body: body.to_string(), local })
    }
}

/// `NAME=VALUE`: a parameter, or the guess of a coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    pub name: String,
    pub value: f64,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, value) = text.rsplit_once('=').ok_or("write NAME=VALUE, such as slot.k=2.5")?;
        let value = number(value).map_err(|reason| {
            format!(
                "the value of `{name}`: {reason}. `kin check FILE --names` lists today's values; lengths are in m and angles in rad, unless the file names other units"
            )
        })?;
        Ok(Setting { name: name.to_string(), value })
    }
}

/// `BODY:X,Y=X,Y` or `BODY:X,Y,Z=X,Y,Z`: a point that is fixed in a body, and its target.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    pub body: String,
    pub local: Vec<f64>,
    pub target: Vec<f64>,
}

impl FromStr for Pull {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form =
            "write BODY:X,Y=X,Y, such as coupler:0.2,0.1=1.5,0.8; a point in space needs Z too";
        let (point, target) = text.rsplit_once('=').ok_or(form)?;
        let (body, local) = point.rsplit_once(':').ok_or(form)?;
        let numbers = |text: &str| -> Result<Vec<f64>, String> {
            let found: Result<Vec<f64>, String> = text.split(',').map(number).collect();
            found.map_err(|reason| format!("the point of `{body}`: {reason}"))
        };
        let local = numbers(local)?;
        let target = numbers(target)?;
        if body.is_empty() || local.len() != target.len() || !matches!(local.len(), 2 | 3) {
            return Err(form.to_string());
        }
        Ok(Pull { body: body.to_string(), local, target })
    }
}

/// `NAME=VALUE` or `NAME`: a value that is given, where it moves to or where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    pub name: String,
    pub value: Option<f64>,
}

impl FromStr for Given {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.contains('=') {
            let Setting { name, value } = text.parse()?;
            return Ok(Given { name, value: Some(value) });
        }
        Ok(Given { name: text.to_string(), value: None })
    }
}

/// `NAME=FROM:TO`: the range of a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    pub name: String,
    pub ends: [f64; 2],
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "write NAME=FROM:TO, such as motor=-0.5:0.8";
        let (name, ends) = text.rsplit_once('=').ok_or(form)?;
        let (from, to) = ends.split_once(':').ok_or(form)?;
        let end = |text| number(text).map_err(|reason| format!("the range of `{name}`: {reason}"));
        Ok(Range { name: name.to_string(), ends: [end(from)?, end(to)?] })
    }
}

/// `I/N`: the I-th of N parts, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shard {
    pub number: usize,
    pub of: usize,
}

impl Shard {
    /// The cases of this part among so many: all parts one after the other are all cases.
    pub fn cases(self, all: usize) -> std::ops::Range<usize> {
        // In numbers so wide that no product overflows.
        let edge = |k: usize| (all as u128 * k as u128 / self.of as u128) as usize;
        edge(self.number - 1)..edge(self.number)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        let shard = parts.filter(|(i, n)| *i >= 1 && i <= n);
        shard
            .map(|(number, of)| Shard { number, of })
            .ok_or_else(|| "write I/N, the I-th of N parts, such as 3/16".to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_all_cases_in_order() {
        for all in [0, 1, 7, 16, 1000] {
            for of in [1, 2, 3, 16, 40] {
                let parts = (1..=of).flat_map(|number| Shard { number, of }.cases(all));
                assert!(parts.eq(0..all), "{all} cases in {of} parts");
            }
        }
    }

    #[test]
    fn what_is_none_is_told() {
        for text in ["0/3", "4/3", "a/3", "3", "1/0", "-1/3"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
        for text in ["P", "P=body", "P=body:1", "=body:1,2", "P=:1,2", "P=body:1,2,3,4"] {
            assert!(text.parse::<NamedPoint>().is_err(), "{text}");
        }
        let named: NamedPoint = "P=left:arm:1,-2e-1".parse().expect("a point");
        assert_eq!(
            (named.name.as_str(), named.body.as_str(), named.local),
            ("P", "left:arm", vec![1.0, -0.2])
        );
        assert_eq!("a=-1:2".parse::<Range>().map(|range| range.ends), Ok([-1.0, 2.0]));
        assert!("a=1".parse::<Range>().is_err() && "a=1:b".parse::<Range>().is_err());
        assert_eq!("a b".parse::<Given>().map(|given| given.value), Ok(None));
        assert_eq!("a=2".parse::<Given>().map(|given| given.value), Ok(Some(2.0)));
        assert!("k".parse::<Setting>().is_err() && "k=nan".parse::<Setting>().is_err());
    }
}
