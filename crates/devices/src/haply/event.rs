use std::borrow::Cow;

use palpate_servo::Fault;
use serde::Deserialize;
use serde_json::Value;

/// An event that the service sends unasked.
#[derive(Debug, Deserialize)]
pub struct Event<'a> {
    #[serde(borrow)]
    name: Cow<'a, str>,
    #[serde(borrow, default)]
    level: Cow<'a, str>,
    #[serde(default)]
    data: Value,
}

impl<'a> Event<'a> {
    /// Reads one.
    ///
    /// # Errors
    /// When it is not an event.
    pub fn parse(text: &'a str) -> Result<Self, Fault> {
        serde_json::from_str(text).map_err(|_| Fault::BadMessage {
            what: "an event that is not as its documents have it",
        })
    }

    /// Why forces have to be off, if it says so about the device `id` or about no device.
    pub fn fault(&self, id: &str) -> Option<Fault> {
        let about = self.data.get("device_id").and_then(Value::as_str);
        if about.is_some_and(|about| about != id) {
            return None;
        }
        let serious = matches!(&*self.level, "error" | "critical" | "panic");
        let safety = |what| Some(Fault::Safety { what });
        match &*self.name {
            "device-disconnected" => Some(Fault::Vanished),
            "device-busy" => safety("another program drives it"),
            "device-safety-triggered" => {
                let kind = self.data.get("safety_type").and_then(Value::as_str);
                match kind.unwrap_or_default() {
                    "ebrake_triggered" => safety("its brake came on"),
                    "ebrake_released" => None,
                    "stall_detected" => safety("its motors stalled"),
                    "stability_ceiling" => safety("it began to swing"),
                    "fod_stage_changed" if !serious => None,
                    _ => safety("one of its safeties came on"),
                }
            }
            name if name.starts_with("device-battery") && serious => safety("its battery is low"),
            "invalid-value" if serious => safety("its service refused a value"),
            _ if matches!(&*self.level, "critical" | "panic") => {
                safety("its service is in distress")
            }
            _ => None,
        }
    }
}
