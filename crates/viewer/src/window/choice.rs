use palpate_files::scene::{
    BuiltinOrgan, DeviceKind, ModelKind, Shading, Shape, Tip, TissueChoice, Tool,
};
use palpate_files::{BuiltinTissue, MouseHand, Scene};

/// A scene and what the side panel has changed in it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Choice {
    given: Scene,
    /// As it was written.
    written: Scene,
    /// Another organ than the scene's.
    pub(super) organ: Option<BuiltinOrgan>,
    /// Another tissue than the scene's.
    pub(super) tissue: Option<BuiltinTissue>,
    /// Which model moves the organ.
    pub(super) model: ModelKind,
    /// The tip of the tool that the mouse moves.
    pub(super) tip: Tip,
    /// The number of that tool.
    pub(super) tool: usize,
}

impl Choice {
    /// Nothing changed yet.
    pub(super) fn new(scene: Scene) -> Self {
        let is_moved = |tool: &Tool| tool.device == DeviceKind::Mouse;
        let tool = scene.tools.iter().position(is_moved).unwrap_or(0);
        Self {
            tip: scene.tools[tool].tip,
            model: scene.model.kind,
            written: scene.clone(),
            given: scene,
            organ: None,
            tissue: None,
            tool,
        }
    }

    /// The tool of that hand is the one that the mouse moves, if there is such a tool and no device moves it.
    #[must_use]
    pub(super) fn with_mouse(mut self, hand: MouseHand) -> Self {
        let is_meant = |tool: &Tool| tool.name == hand.word() && !tool.device.is_haptic();
        if hand != MouseHand::Scene
            && let Some(number) = self.tools().iter().position(is_meant)
        {
            self.take(number);
        }
        self
    }

    /// Whether the scene draws its numbers for each attempt.
    pub(super) fn draws(&self) -> bool {
        self.given.draws.is_some()
    }

    /// The scene that this comes to.
    pub(super) fn scene(&self) -> Scene {
        let mut scene = self.given.clone();
        if let Some(organ) = self.organ {
            scene.organ.shape = Shape::Builtin {
                organ,
                triangles: Some(fineness(organ)),
            };
            scene.organ.anchor = None;
            scene.neighbours.clear();
            // Trocars and cameras are places around the other organ.
            scene.view.eye_m = None;
            scene.view.target_m = None;
            for tool in &mut scene.tools {
                tool.trocar_m = None;
            }
        }
        scene.model.kind = self.model;
        if let Some(tissue) = self.tissue {
            scene.organ.tissue = TissueChoice::Builtin(tissue);
        }
        if let Some(tool) = scene.tools.get_mut(self.tool) {
            tool.tip = self.tip;
        }
        if scene != self.written {
            scene.written = None;
        }
        scene
    }

    /// Makes the tool of that number the one that the mouse moves, unless a hand feels it by a device of its own.
    pub(super) fn take(&mut self, tool: usize) {
        // What was changed at the tool before stays changed.
        self.given.tools[self.tool].tip = self.tip;
        self.tool = tool.min(self.given.tools.len() - 1);
        self.tip = self.given.tools[self.tool].tip;
        let (given, written) = (&mut self.given, &mut self.written);
        // The hand that moves a tool does not affect the force.
        for device in [given, written].map(|scene| &mut scene.tools[self.tool].device) {
            if !device.is_haptic() {
                *device = DeviceKind::Mouse;
            }
        }
    }

    /// The tools of the scene.
    pub(super) fn tools(&self) -> &[Tool] {
        &self.given.tools
    }

    /// Where the scene's own organ comes from, in words.
    pub(super) fn given_organ(&self) -> String {
        match &self.given.organ.shape {
            Shape::Builtin { organ, .. } => format!("{} (scene)", organ.word()),
            Shape::Mesh { path, .. } => path.file_name().map_or_else(
                || path.display().to_string(),
                |name| name.to_string_lossy().into_owned(),
            ),
        }
    }

    /// How the scene wants its organ drawn.
    pub(super) fn shading(&self) -> Shading {
        self.given.view.shading
    }
}

/// Triangles that show the dimple of a small tip.
fn fineness(organ: BuiltinOrgan) -> usize {
    match organ {
        BuiltinOrgan::Liver => 20_000,
        BuiltinOrgan::Esophagus => 14_000,
        BuiltinOrgan::Kidney
        | BuiltinOrgan::Spleen
        | BuiltinOrgan::Stomach
        | BuiltinOrgan::Diaphragm
        | BuiltinOrgan::Hemisphere
        | BuiltinOrgan::Cube
        | BuiltinOrgan::Slab => 14_000,
    }
}
