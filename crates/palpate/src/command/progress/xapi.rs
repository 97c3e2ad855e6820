//! Attempts as statements of the Experience API (xAPI 1.0.3), which learning record stores read: who, passed or failed
//! what, when, with which measures. Names of accounts are those of the record.

use palpate_record::Attempt;
use serde_json::{Value, json};

use super::learning_curves::{JudgedAttempt, LearningCurve};
use crate::date;

/// Prefix of the names that only this program defines.
const HOME: &str = "https://palpate.invalid";

/// The statements of all attempts of trainees.
pub(super) fn statements(courses: &[LearningCurve<'_>]) -> Vec<Value> {
    let trainees = courses.iter().flat_map(|course| &course.trainees);
    let made = trainees.flat_map(|own| &own.attempts);
    made.map(statement).collect()
}

fn statement(made: &JudgedAttempt<'_>) -> Value {
    let own = made.attempt;
    let (verb, word) = match own.passed {
        Some(true) => ("http://adlnet.gov/expapi/verbs/passed", "passed"),
        Some(false) => ("http://adlnet.gov/expapi/verbs/failed", "failed"),
        None => ("http://adlnet.gov/expapi/verbs/completed", "completed"),
    };
    let mut result = json!({ "completion": true, "extensions": measures(own) });
    if let Some(passed) = own.passed {
        result["success"] = passed.into();
    }
    if let Some(time) = made.time() {
        result["duration"] = format!("PT{time:.2}S").into();
    }
    json!({
        "actor": {
            "objectType": "Agent",
            "account": { "homePage": HOME, "name": own.trainee },
        },
        "verb": { "id": verb, "display": { "en": word } },
        "object": {
            "objectType": "Activity",
            "id": format!("{HOME}/task/{}", escaped(&own.task)),
            "definition": {
                "name": { "en": own.task },
                "type": "http://adlnet.gov/expapi/activities/simulation",
            },
        },
        "result": result,
        "timestamp": date::exact(own.when),
    })
}

fn measures(attempt: &Attempt) -> Value {
    let each = attempt.measures.iter();
    let each = each.map(|own| {
        (
            format!("{HOME}/measure/{}", escaped(&own.key)),
            own.value.into(),
        )
    });
    Value::Object(each.collect())
}

/// A name as a part of an address: everything but letters, digits, `.`, `-` and `_` as its bytes.
fn escaped(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b".-_".contains(&byte);
    let each = name.bytes().map(|byte| match plain(byte) {
        true => char::from(byte).to_string(),
        false => format!("%{byte:02X}"),
    });
    each.collect()
}
