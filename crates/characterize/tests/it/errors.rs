//! Every error is one sentence: cause, then remedy.

use palpate_characterize::Error;
use palpate_characterize::fit::Parameter;

#[test]
fn messages() {
    let cases = [
        (
            Error::ConstantForce { force: 0.5 },
            "the force is 0.5 N in every sample; check that the sensor was connected",
        ),
        (
            Error::NoContact {
                cause: "the depth never gets above zero",
            },
            "no contact is found, because the depth never gets above zero; \
             check the signs and units, or record until the tissue is pressed",
        ),
        (
            Error::ContactOutside {
                time: 11.0,
                first: 0.0,
                last: 10.0,
            },
            "the contact is stated at 11 s; give a time from 0 to 10 s",
        ),
        (
            Error::BadCutoff {
                cutoff: 60.0,
                rate: 100.0,
            },
            "the cut-off is 60 Hz with 100 samples a second; give one above 0 and below half of that",
        ),
        (
            Error::TooShort {
                samples: 1,
                least: 5,
                task: "finding the contact",
            },
            "the recording has 1 samples, and finding the contact takes at least 5; \
             record for longer or faster",
        ),
        (
            Error::BadParameter {
                parameter: Box::new(Parameter::new("c10_pa", 5.0).within(10.0, 20.0)),
            },
            "c10_pa starts at 5e0 with the scale 5e0, which does not lie between its bounds 1e1 \
             and 2e1 or is no number; start inside, with a scale above 0",
        ),
        (
            Error::NoStart {
                parameters: vec![Parameter::new("c10_pa", 5.0), Parameter::new("c01_pa", 7.0)],
            },
            "the model has no answer where its fit starts, at c10_pa = 5, c01_pa = 7; \
             start elsewhere",
        ),
        (
            Error::HollowOrgan,
            "the organ is hollow, and a mean modulus is that of a half-space; \
             fit a tube to it instead",
        ),
        (
            Error::NoHold,
            "no recording stays at a depth, and a mean modulus is that of a steady force; \
             record a ramp and a hold",
        ),
    ];
    for (error, message) in cases {
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn what_cannot_be_characterized_is_said() {
    let said = |error: Error| error.to_string();
    assert_eq!(
        said(Error::Unknown { key: "area_m2" }),
        "the recording does not say `area_m2`; add the line `# area_m2 = ...` at its top, or state it with --set"
    );
    assert!(
        said(Error::NoContactForce).ends_with("check the signs and the units of depth and force")
    );
    let law = palpate_files::tissue::LawName::MooneyRivlin;
    assert!(said(Error::TubeLaw { law }).starts_with("`mooney_rivlin` is not sought"));
    assert!(
        said(Error::CostlyToRepeat { law }).starts_with("fits of `mooney_rivlin` are not repeated")
    );
    let unsolved = said(Error::NotSolved {
        law,
        asked: 8e-3,
        reached: 5.4e-3,
        failure: palpate_mechanics::finite_elements::Failure::NotConverged,
    });
    assert_eq!(
        unsolved,
        "the force of the `mooney_rivlin` law could not be solved down to 8.000 mm, the deepest that was recorded, \
         but down to 5.400 mm only (the iteration did not end); leave out what was recorded deeper, or choose another \
         law with --law"
    );
    assert!(said(Error::TubeIndenter).ends_with("use a flat one"));
    let thin = Error::DeeperThanThick {
        depth: 5e-3,
        thickness: 4e-3,
    };
    assert!(said(thin).ends_with("check the units, or correct `thickness_m`"));
    let narrow = Error::Narrow {
        radius: 1e-3,
        least: 2e-3,
    };
    assert!(said(narrow).ends_with("correct `specimen_radius_m` or `specimen_width_m`"));
    assert!(said(Error::ColumnUnknown).ends_with("or record the ramp faster"));
}
