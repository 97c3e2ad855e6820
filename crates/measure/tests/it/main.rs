//! Tests of the rig on a virtual clock.

mod rig;
