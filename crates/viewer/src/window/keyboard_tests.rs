//! The whole window without a display, by keys and screen reader alone.
//!
//! Judge: the accessibility tree that the operating system gets.

use std::path::PathBuf;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use eframe::egui_wgpu::{RenderState, RendererOptions, WgpuConfiguration};
use eframe::{App, CreationContext, Frame};
use palpate_files::scene::Task;
use palpate_files::{Language, Scene, Settings};

use super::settings::{CacheUse, NamedFolder, SettingsStore, WindowSettings};
use super::test_page::TestPage;
use super::texts::text;
use super::training::{
    Assigned, Class, NewAssignment, OfferedTask, PastResult, TaskPicture, TaskProgress,
    TraineeProgress, Training, TrainingRecord, TrainingResult,
};
use super::{SimulatorWindow, Start, WindowOptions};

const SCENE: &str = r#"
format = 1
[organ]
builtin = "cube"
builtin_tissue = "pig-liver"
[[tool]]
name = "right"
[task]
title = "Press"
instructions = "Press on the cube."
time_limit_s = 60.0
force_limit_n = 0.5
[task.find]
target_m = [0.0, 0.0, 0.05]
tolerance_m = 0.005
"#;

/// What a window keeps, in memory and a folder.
struct Kept {
    sessions: PathBuf,
    results: Vec<PastResult>,
}

impl TrainingRecord for Kept {
    fn new_session(&self, _task: &Task) -> PathBuf {
        self.sessions.join(self.results.len().to_string())
    }

    fn keep(&mut self, result: &TrainingResult<'_>) -> Result<(), String> {
        self.results.push(PastResult {
            task: "Press".to_owned(),
            date: "2026-11-26".to_owned(),
            passed: result.score.outcome.passed(),
            time: result.score.duration,
            errors: 0,
            session: result.session.to_owned(),
        });
        Ok(())
    }

    fn assigned(&self, _trainee: &str) -> Result<Vec<Assigned>, String> {
        Ok(vec![Assigned {
            task: "Press".to_owned(),
            due: "2026-12-24".to_owned(),
            passed: 0,
            passes: 2,
            is_over: false,
        }])
    }

    fn class(&self) -> Result<Class, String> {
        Ok(Class {
            assignees: vec!["Anna".to_owned()],
            assignments: Vec::new(),
            tasks: vec![TaskProgress {
                task: "Press".to_owned(),
                trainees: vec![TraineeProgress {
                    trainee: "Anna".to_owned(),
                    attempts: 2,
                    passed: 1,
                    proficient_since: None,
                    times: vec![[1.0, 40.0], [2.0, 30.0]],
                }],
                mean_times: vec![[1.0, 40.0], [2.0, 30.0]],
                expert_time: None,
            }],
        })
    }

    fn assign(&mut self, _given: &NewAssignment) -> Result<(), String> {
        Ok(())
    }

    fn results(&self, _trainee: &str) -> Result<Vec<PastResult>, String> {
        Ok(self.results.clone())
    }
}

struct Forgetful;

impl SettingsStore for Forgetful {
    fn save(&mut self, _settings: &Settings) -> Result<(), String> {
        Ok(())
    }

    fn devices(&self) -> Vec<String> {
        Vec::new()
    }

    fn folders(&self) -> Vec<NamedFolder> {
        Vec::new()
    }

    fn cache(&self) -> Result<CacheUse, String> {
        Ok(CacheUse { files: 0, bytes: 0 })
    }

    fn clear_cache(&mut self) -> Result<CacheUse, String> {
        self.cache()
    }
}

/// The window, its frame and its screen reader.
struct Used {
    window: SimulatorWindow,
    frame: Frame,
    seen: TestPage,
    /// Kept as long as the window.
    _folder: tempfile::TempDir,
}

/// None without a graphics adapter, which a machine for tests may lack.
fn render_state() -> Option<RenderState> {
    let instance = wgpu::Instance::default();
    let configuration = WgpuConfiguration::default();
    let created = RenderState::create(&configuration, &instance, None, RendererOptions::default());
    pollster::block_on(created).ok()
}

impl Used {
    fn new(language: Language) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let seen = TestPage::default();
        let mut context = CreationContext::_new_kittest(seen.context().clone());
        let mut frame = Frame::_new_kittest();
        context.wgpu_render_state = render_state();
        frame.wgpu_render_state = context.wgpu_render_state.clone();
        context.wgpu_render_state.as_ref()?;
        let scene = Scene::parse(SCENE, "press.toml").unwrap();
        let without_task = SCENE.split("[task]").next().unwrap();
        let free = Scene::parse(without_task, "free.toml").unwrap();
        let options = WindowOptions {
            fallback: free.clone(),
            resources: palpate_simulate::Resources::default(),
            training: Some(Training {
                tasks: vec![OfferedTask {
                    scene,
                    picture: Some(TaskPicture {
                        pixels: vec![128; 16],
                        size: [2, 2],
                    }),
                }],
                free,
                sessions: folder.path().to_owned(),
                trainee: "Anna".to_owned(),
                record: Box::new(Kept {
                    sessions: folder.path().to_owned(),
                    results: Vec::new(),
                }),
            }),
            settings: WindowSettings {
                settings: Settings::default(),
                environment: language,
                asked_language: None,
                error: None,
                store: Box::new(Forgetful),
            },
            is_ended: || false,
        };
        let mut used = Self {
            window: SimulatorWindow::new(&context, Start::Home, options).unwrap(),
            frame,
            seen,
            _folder: folder,
        };
        used.look();
        Some(used)
    }

    /// Shows a picture, and another one for what came of it.
    fn look(&mut self) {
        for _ in 0..2 {
            let mut input = self.seen.input();
            let context = self.seen.context().clone();
            self.window.raw_input_hook(&context, &mut input);
            let (window, frame) = (&mut self.window, &mut self.frame);
            self.seen.run(input, |ui| window.ui(ui, frame));
        }
        let unnamed = self.seen.unnamed();
        assert!(
            unnamed.is_empty(),
            "{unnamed:?} among {:?}",
            self.seen.labels()
        );
    }

    fn press(&mut self, key: Key) {
        self.seen.press(key);
        self.look();
    }

    fn has(&self, words: &str) -> bool {
        self.seen.labels().iter().any(|(_, label)| label == words)
    }

    /// Waits until somebody reads these words.
    fn wait(&mut self, words: &str) {
        for _ in 0..3000 {
            if self.has(words) {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
            self.look();
        }
        panic!("no `{words}` among {:?}", self.seen.labels());
    }

    /// Goes to a button by Tab, or by Shift and Tab where Tab is a key of the tools, and presses Enter there.
    fn choose(&mut self, words: &str, modifiers: Modifiers) {
        for _ in 0..60 {
            if self.seen.focused() == words {
                self.press(Key::Enter);
                return;
            }
            self.seen.press_with(Key::Tab, modifiers);
            self.look();
        }
        panic!("`{words}` is not reached among {:?}", self.seen.labels());
    }
}

/// From the start screen through an attempt, its pause, its end and its replay, and back; each page has names for all
/// that may have the focus.
#[test]
fn an_attempt_is_made_by_keys_alone() {
    let Some(mut used) = Used::new(Language::English) else {
        eprintln!("no graphics adapter: nothing is tested");
        return;
    };
    assert!(used.has("open") && used.has("Press: pass 2 times by 2026-12-24; 0 so far"));
    used.choose("Open Press", Modifiers::NONE);
    used.wait(&text!("attempt-begin"));
    assert!(used.has("Press on the cube."));
    used.choose(&text!("attempt-begin"), Modifiers::NONE);
    used.wait(&text!("attempt-end"));
    used.wait(&text!("picture-organ"));
    used.press(Key::P);
    used.wait(&text!("hint-paused"));
    used.press(Key::P);
    used.press(Key::Questionmark);
    used.choose(&text!("attempt-end"), Modifiers::SHIFT);
    used.wait("Not passed: no place was marked");
    assert!(used.has(&text!("result-first")));
    used.choose(&text!("common-replay"), Modifiers::NONE);
    used.wait(&text!("replay-time"));
    used.choose(&text!("replay-leave"), Modifiers::NONE);
    used.wait(&text!("home-you"));
    let labels = used.seen.labels();
    let tried = |label: &str| label.starts_with("tried once, passed 0;");
    assert!(labels.iter().any(|(_, label)| tried(label)), "{labels:?}");
    used.choose("Replay Press, 2026-11-26", Modifiers::NONE);
    used.wait(&text!("replay-time"));
}

/// Settings, trainees and free play have names for all that may have the focus, and Escape leaves them.
#[test]
fn other_pages_are_read_and_left_by_keys() {
    let Some(mut used) = Used::new(Language::German) else {
        eprintln!("no graphics adapter: nothing is tested");
        return;
    };
    used.press(Key::F2);
    assert!(used.has("Sprache"), "{:?}", used.seen.labels());
    used.press(Key::Escape);
    used.press(Key::F3);
    assert!(used.has("Press: Zeit [s] über den Versuchen"));
    used.press(Key::Escape);
    used.choose("Freies Üben öffnen", Modifiers::NONE);
    used.wait("Bild des Organs");
    for (role, label) in [
        (Role::Image, "Kraft [mN]"),
        (Role::ComboBox, "Organ"),
        (Role::Slider, "Radius"),
    ] {
        let labels = used.seen.labels();
        assert!(used.seen.has(role, label), "{label}: {labels:?}");
    }
    super::texts::set_language(Language::English);
}
