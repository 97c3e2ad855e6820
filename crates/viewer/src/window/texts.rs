//! The texts of the pages of settings and of the teacher, in one place for translators.

pub(super) const SETTINGS: &str = "Settings";
pub(super) const BACK: &str = "Back";
pub(super) const BACK_HINT: &str = "or Esc";
pub(super) const HANDS: &str = "Hands";
pub(super) const MOUSE_HAND: &str = "The mouse moves";
pub(super) const MOUSE_HANDS: [&str; 3] = [
    "the tool that the scene names",
    "the left hand\u{2019}s tool",
    "the right hand\u{2019}s tool",
];
pub(super) const OTHER_HAND: &str = "Keys move both hands at once: W A S D the left one, I J K L the right one. Tab hands the mouse the other tool.";
pub(super) const DISPLAY: &str = "Display";
pub(super) const SCALE: &str = "Size of texts and buttons";
pub(super) const FOLDERS: &str = "Folders";
pub(super) const TRAINING_FOLDER: &str = "Folder of sessions and results";
pub(super) const TRAINING_FOLDER_HINT: &str = "empty: the folder of the system";
pub(super) const SAVE_FOLDER: &str = "Set the folder";
pub(super) const NEXT_START: &str = "It is used from the next start on.";
pub(super) const CACHE: &str = "Cache of prepared organs";
pub(super) const CLEAR_CACHE: &str = "Clear the cache";
pub(super) const CLEAR_HINT: &str = "Each organ is prepared again when it is needed.";
pub(super) const DEVICES: &str = "Haptic devices";
pub(super) const LOOK_FOR_DEVICES: &str = "Look for devices";

pub(super) const CLASS: &str = "Trainees";
pub(super) const ASSIGNMENTS: &str = "Assignments";
pub(super) const NO_ASSIGNMENT: &str = "Nothing is assigned. `palpate teacher assign COHORT TASK --due DATE` assigns a task to a cohort.";
pub(super) const LEARNING: &str = "Learning curves";
pub(super) const NO_ATTEMPT: &str = "No attempt is recorded yet.";
pub(super) const TIMES: &str = "Time [s] over attempts";
