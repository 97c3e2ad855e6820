use super::{Outcome, SizeOutcome};

/// The outcome of a task, in a sentence for the trainee.
pub fn outcome_words(outcome: &Outcome) -> String {
    match *outcome {
        Outcome::Free => "Nothing had to be done.".to_owned(),
        Outcome::Find {
            target_distance: None,
            ..
        } => "No place was marked.".to_owned(),
        Outcome::Find {
            target_distance: Some(target_distance),
            found,
            size,
        } => format!(
            "{}, {:.1} mm from its middle.{}",
            if found { "Found" } else { "Missed" },
            1e3 * target_distance,
            size.map_or(String::new(), |size| format!(" {}", size_words(&size)))
        ),
        Outcome::Traction {
            torn: Some(force), ..
        } => format!("The tissue tore, under a pull of {:.0} mN.", 1e3 * force),
        Outcome::Traction {
            within,
            error,
            held,
            torn: None,
        } => {
            let off = error.map_or(String::new(), |error| {
                format!(", {:.0} mN off on average", 1e3 * error)
            });
            match held {
                true => format!("The force was held for {within:.1} s{off}."),
                false => format!("The force was held for only {within:.1} s{off}."),
            }
        }
        Outcome::Touch {
            torn: Some(force), ..
        } => format!(
            "The held tissue tore, under a pull of {:.0} mN.",
            1e3 * force
        ),
        Outcome::Touch {
            injured: Some(force),
            ..
        } => format!(
            "What was touched is injured, by a force of {:.0} mN.",
            1e3 * force
        ),
        Outcome::Touch {
            within,
            target_distance,
            reached,
            injured: None,
            torn: None,
        } => match (reached, target_distance) {
            (true, _) => format!("The target was touched for {within:.1} s."),
            (false, None) => {
                "The target was not touched: the organ was not held out of the way.".to_owned()
            }
            (false, Some(target_distance)) => format!(
                "The target was touched for only {within:.1} s; the tip came within {:.1} mm of it.",
                1e3 * target_distance
            ),
        },
        Outcome::Cut { part, clean } => match clean {
            true => "The line is cut, straight and without a perforation.".to_owned(),
            false => format!(
                "{:.0} % of the line is cut to the depth asked for; see deviation and perforations.",
                100.0 * part
            ),
        },
    }
}

/// The stated size and the true one.
fn size_words(size: &SizeOutcome) -> String {
    let truth = 2e3 * size.truth.radius_m;
    match size.stated {
        None => format!("Its diameter is {truth:.1} mm; none was stated."),
        Some(stated) => format!(
            "Its diameter is {truth:.1} mm; {:.1} mm was stated.",
            1e3 * stated
        ),
    }
}
