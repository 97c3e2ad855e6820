//! The estimate while tissue is pressed.

use palpate_characterize::online::{
    OnlineContact, OnlineEstimate as Estimate, OnlineEstimator, OnlineSample, OnlineSettings,
};
use palpate_files::Recording as Document;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::Failure;
use crate::{documents, numbers};

/// Modulus and relaxation of tissue while it is pressed, with their 95 % intervals.
///
/// Each sample costs microseconds; `estimate` fits the samples so far, which takes tenths of a second however
/// many they are. The law is neo-Hookean, the relaxation has two terms, and one press is estimated.
///
/// Parameters
/// ----------
/// header : dict
///     What is known of the specimen and the indenter, by the keys of a recording's file; `indenter_radius_m` at
///     least. Of anything but a flat punch on a large piece, the force over depth is solved by finite elements here,
///     which takes seconds to minutes.
/// contact_error : float, optional
///     Depths count from first contact, which is known with this standard error [m]. If not given, depths count from
///     anywhere, and the contact is where the force rises: begin above the tissue.
/// deepest : float, optional
///     The deepest press [m]; eight radii of the indenter if not given.
#[pyclass(module = "palpate")]
#[derive(Debug)]
pub(crate) struct OnlineEstimate {
    online: OnlineEstimator,
    /// The estimate from the samples so far, until another is added.
    last: Option<Estimate>,
}

#[pymethods]
impl OnlineEstimate {
    #[new]
    #[pyo3(signature = (header, *, contact_error=None, deepest=None))]
    fn new(
        header: &Bound<'_, PyDict>,
        contact_error: Option<f64>,
        deepest: Option<f64>,
    ) -> Result<Self, Failure> {
        let is_wrong = |error: &f64| !(*error >= 0.0 && error.is_finite());
        if let Some(wrong) = contact_error.filter(is_wrong) {
            return Err(Failure::input(format!(
                "`contact_error` is {wrong}; give a length in metres, not negative"
            )));
        }
        if let Some(wrong) = deepest.filter(|own| !(*own > 0.0 && own.is_finite())) {
            return Err(Failure::input(format!(
                "`deepest` is {wrong}; give a length in metres above zero"
            )));
        }
        let text = documents::header(header)? + "time_s,depth_m,force_n\n0,0,0\n";
        let settings = OnlineSettings {
            header: Document::parse(&text, "header")?.header,
            contact: match contact_error {
                Some(error_m) => OnlineContact::Stated { error_m },
                None => OnlineContact::Detected,
            },
            deepest_m: deepest,
        };
        let online = OnlineEstimator::new(settings).map_err(Failure::input)?;
        Ok(Self { online, last: None })
    }

    /// Takes a sample, or several in the order of time at an even rate.
    ///
    /// Parameters
    /// ----------
    /// time_s : float or array_like, shape (n,)
    ///     The times [s]; a sample that is not later than the one before, or not finite, is skipped.
    /// depth_m : float or array_like, shape (n,)
    ///     The depths [m], positive into the tissue.
    /// force_n : float or array_like, shape (n,)
    ///     The forces on the tissue [N], positive into it.
    fn add(
        &mut self,
        time_s: &Bound<'_, PyAny>,
        depth_m: &Bound<'_, PyAny>,
        force_n: &Bound<'_, PyAny>,
    ) -> Result<(), Failure> {
        let several = |given: &Bound<'_, PyAny>, name| match given.extract::<f64>() {
            Ok(one) => Ok(vec![one]),
            Err(_) => numbers::list(given, name),
        };
        let time = several(time_s, "time_s")?;
        let depth = several(depth_m, "depth_m")?;
        let force = several(force_n, "force_n")?;
        let counts = [time.len(), depth.len(), force.len()];
        if counts.iter().any(|count| *count != counts[0]) {
            let [times, depths, forces] = counts;
            return Err(Failure::input(format!(
                "`time_s` has {times} numbers, `depth_m` {depths} and `force_n` {forces}; give one of each for every sample"
            )));
        }
        for ((time_s, depth_m), force_n) in time.into_iter().zip(depth).zip(force) {
            self.online.add(OnlineSample {
                time_s,
                depth_m,
                force_n,
            });
        }
        self.last = None;
        Ok(())
    }

    /// Each parameter by its name, c10_pa, g_1, tau_1_s, g_2 and tau_2_s: a dict with its `value`, its 95 % `interval`,
    /// and whether it is `known`; what is not known yet has no interval.
    #[getter]
    fn estimate<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for own in self.latest(py).parameters {
            let one = PyDict::new(py);
            one.set_item("value", own.value)?;
            one.set_item("interval", own.interval_95.map(<(f64, f64)>::from))?;
            one.set_item("known", own.is_known())?;
            all.set_item(own.name, one)?;
        }
        Ok(all)
    }

    /// The time since first contact [s].
    #[getter]
    fn time(&mut self, py: Python<'_>) -> f64 {
        self.latest(py).time_s
    }

    /// Whether the tissue was touched.
    #[getter]
    fn touching(&self) -> bool {
        self.online.is_touching()
    }

    /// Samples that were skipped: not finite, or not later than the one before.
    #[getter]
    fn skipped(&self) -> usize {
        self.online.skipped()
    }

    /// Whether half the interval of every parameter is at most `target` of its value.
    #[pyo3(signature = (target=0.1))]
    fn is_enough(&mut self, py: Python<'_>, target: f64) -> bool {
        self.latest(py).is_enough(target)
    }

    /// Forgets the press, for the next one.
    fn restart(&mut self) {
        self.online.restart();
        self.last = None;
    }

    fn __repr__(&mut self, py: Python<'_>) -> String {
        format!("<palpate.OnlineEstimate {}>", self.latest(py))
    }
}

impl OnlineEstimate {
    fn latest(&mut self, py: Python<'_>) -> Estimate {
        let Self { online, last } = self;
        last.get_or_insert_with(|| py.detach(|| online.estimate()))
            .clone()
    }
}
