//! A page without a window, for tests: its accessibility tree, clicks and keys.

use eframe::egui::accesskit::{Node, Role};
use eframe::egui::{Context, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, Ui, Vec2};

/// A page as somebody sees it who reads the accessibility tree.
pub(crate) struct Seen {
    context: Context,
    nodes: Vec<Node>,
    events: Vec<Event>,
}

impl Default for Seen {
    fn default() -> Self {
        let context = Context::default();
        context.enable_accesskit();
        Self {
            context,
            nodes: Vec::new(),
            events: Vec::new(),
        }
    }
}

impl Seen {
    /// Shows the page once, with the clicks and keys since the last time.
    pub(crate) fn show(&mut self, mut page: impl FnMut(&mut Ui)) {
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(1280.0, 1600.0))),
            events: std::mem::take(&mut self.events),
            ..RawInput::default()
        };
        let mut output = self.context.run_ui(input, |ui| page(ui));
        // Nobody draws it.
        output.textures_delta.clear();
        if let Some(update) = output.platform_output.accesskit_update {
            self.nodes = update.nodes.into_iter().map(|(_, node)| node).collect();
        }
    }

    fn find(&self, role: Role, label: &str) -> Option<&Node> {
        let is_meant = |node: &&Node| {
            let own = node.label().or(node.value());
            node.role() == role && own.is_some_and(|own| own == label)
        };
        self.nodes.iter().find(is_meant)
    }

    /// Whether there is a node with this role and label.
    pub(crate) fn has(&self, role: Role, label: &str) -> bool {
        self.find(role, label).is_some()
    }

    /// Roles and labels of all nodes.
    pub(crate) fn labels(&self) -> Vec<(Role, String)> {
        let own = |node: &Node| {
            let label = node.label().or(node.value()).unwrap_or_default();
            (node.role(), label.to_owned())
        };
        self.nodes.iter().map(own).collect()
    }

    /// Clicks in the middle of a node.
    pub(crate) fn click(&mut self, role: Role, label: &str) {
        let node = self.find(role, label);
        let bounds = node.and_then(Node::bounds);
        let Some(bounds) = bounds else {
            panic!("no {role:?} `{label}` among {:?}", self.labels())
        };
        let pos = Pos2::new(
            (0.5 * (bounds.x0 + bounds.x1)) as f32,
            (0.5 * (bounds.y0 + bounds.y1)) as f32,
        );
        self.events.push(Event::PointerMoved(pos));
        for pressed in [true, false] {
            self.events.push(Event::PointerButton {
                pos,
                button: PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            });
        }
    }

    /// Presses a key.
    pub(crate) fn press(&mut self, key: Key) {
        for pressed in [true, false] {
            self.events.push(Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            });
        }
    }
}
