//! Two ways to the same force.

use palpate_geometry::AabbTree;

use crate::scenes::{Hand, Random, Setting, nearest};

/// The equations of all steps judge the response that is made once. 3 % is what a user is promised.
#[test]
fn reused_assembly_agrees_with_that_of_every_step() {
    for organ in ["liver", "kidney", "stomach", "spleen", "esophagus"] {
        let builtin = format!("builtin = \"{organ}\"");
        let with = |model| {
            let setting = Setting {
                organ: &builtin,
                model,
                ..Setting::default()
            };
            setting.simulation()
        };
        let every = with("assembly = \"every_step\"");
        let reused = with("assembly = \"reused\"");
        let tree = AabbTree::new(every.surface().mesh());
        let mut random = Random(3);
        let mut worst = 0.0_f64;
        for _ in 0..200 {
            let (point, _, _) = random.place(&every);
            let (point, normal) = nearest(&every, &tree, &point);
            let tip = point - normal * (5e-4 + 2.5e-3 * random.unit());
            let judge = Hand::new(&every).at(&tip);
            let found = Hand::new(&reused).at(&tip);
            assert_eq!(judge.norm() > 0.0, found.norm() > 0.0);
            if judge.norm() > 0.0 {
                worst = worst.max((found - judge).norm() / judge.norm());
            }
        }
        println!(
            "{organ}: reused assembly differs by {:.3} % at most",
            100.0 * worst
        );
        assert!(worst < 0.03, "{organ}: {worst}");
    }
}
