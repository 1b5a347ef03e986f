//! Lengths in words: millimetres and centimetres where the groom's unit is known.

/// What lengths are shown in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    metres: Option<f64>,
}

/// A unit to show values in: what the groom's own numbers are multiplied by, and its name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shown {
    pub(crate) factor: f64,
    pub(crate) name: String,
}

impl Units {
    /// Of a groom of so many metres a unit, if that is known.
    pub(crate) fn new(metres: Option<f64>) -> Self {
        Self { metres }
    }

    /// The groom's own unit of length.
    pub(crate) fn own(self) -> String {
        match self.metres {
            Some(1.0) => "m".into(),
            Some(0.01) => "cm".into(),
            Some(0.001) => "mm".into(),
            Some(metres) => format!("{metres} m"),
            None => "unit".into(),
        }
    }

    /// The same behind a number.
    pub(crate) fn behind_numbers(self) -> String {
        match self.metres {
            Some(1.0 | 0.01 | 0.001) => self.own(),
            Some(metres) => format!("units of {metres} m"),
            None => "units".into(),
        }
    }

    /// For radii and pitches: millimetres.
    pub(crate) fn coil(self) -> Shown {
        self.length(1e3, "mm")
    }

    /// For strands: centimetres.
    pub(crate) fn strand(self) -> Shown {
        self.length(1e2, "cm")
    }

    /// For what is counted a length: a centimetre.
    pub(crate) fn per_length(self, what: &str) -> Shown {
        let Shown { factor, name } = self.length(1e2, "cm");
        let what = if what.is_empty() { "1" } else { what };
        Shown { factor: 1.0 / factor, name: format!("{what}/{name}") }
    }

    /// For pure numbers.
    pub(crate) fn none() -> Shown {
        Shown { factor: 1.0, name: String::new() }
    }

    fn length(self, in_a_metre: f64, name: &str) -> Shown {
        match self.metres {
            Some(metres) => Shown { factor: in_a_metre * metres, name: name.into() },
            None => Shown { factor: 1.0, name: "unit".into() },
        }
    }
}

impl Shown {
    /// A name with this unit behind it.
    pub(crate) fn titled(&self, title: &str) -> String {
        if self.name.is_empty() { title.into() } else { format!("{title} ({})", self.name) }
    }

    /// Values in this unit.
    pub(crate) fn of(&self, values: impl IntoIterator<Item = f64>) -> Vec<f64> {
        values.into_iter().map(|value| value * self.factor).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_units_become_millimetres_and_centimetres() {
        let inches = Units::new(Some(0.0254));
        assert!((inches.coil().factor - 25.4).abs() < 1e-12);
        let rate = inches.per_length("turns");
        assert!((rate.factor - 1.0 / 2.54).abs() < 1e-12 && rate.name == "turns/cm");
        let unknown = Units::new(None);
        assert_eq!((unknown.coil().factor, unknown.own()), (1.0, "unit".into()));
        let behind = [Some(0.01), Some(0.0254), None].map(|m| Units::new(m).behind_numbers());
        assert_eq!(behind, ["cm", "units of 0.0254 m", "units"]);
        assert_eq!(unknown.per_length("").name, "1/unit");
    }
}
