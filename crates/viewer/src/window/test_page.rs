//! A page without a window, for tests: its accessibility tree, clicks and keys.

use eframe::egui::accesskit::{Action, Node, NodeId, Role};
use eframe::egui::{Context, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, Ui, Vec2};

/// A page as somebody sees it who reads the accessibility tree.
pub(crate) struct TestPage {
    context: Context,
    nodes: Vec<(NodeId, Node)>,
    events: Vec<Event>,
    /// A button is let go a picture later than it was pressed, as by a hand.
    later: Vec<Event>,
    focus: Option<NodeId>,
    /// Of the next picture [s].
    time: f64,
}

impl Default for TestPage {
    fn default() -> Self {
        let context = Context::default();
        context.enable_accesskit();
        Self {
            context,
            nodes: Vec::new(),
            events: Vec::new(),
            later: Vec::new(),
            focus: None,
            time: 0.0,
        }
    }
}

impl TestPage {
    /// Shows the page once, with the presses and keys since the last time.
    pub(crate) fn show(&mut self, page: impl FnMut(&mut Ui)) {
        let input = self.input();
        self.run(input, page);
    }

    /// What somebody did since the last picture.
    pub(crate) fn input(&mut self) -> RawInput {
        self.time += 0.02;
        RawInput {
            time: Some(self.time),
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(1280.0, 1600.0))),
            events: std::mem::replace(&mut self.events, std::mem::take(&mut self.later)),
            ..RawInput::default()
        }
    }

    /// Shows a picture with that input.
    pub(crate) fn run(&mut self, input: RawInput, mut page: impl FnMut(&mut Ui)) {
        let mut output = self.context.run_ui(input, |ui| page(ui));
        // Nobody draws it.
        output.textures_delta.clear();
        if let Some(update) = output.platform_output.accesskit_update {
            self.nodes = update.nodes;
            self.focus = Some(update.focus);
        }
    }

    /// What it is shown in.
    pub(crate) fn context(&self) -> &Context {
        &self.context
    }

    /// The label of what has the keyboard's focus.
    pub(crate) fn focused(&self) -> &str {
        let own = self.nodes.iter().find(|(id, _)| Some(*id) == self.focus);
        own.map_or("", |(_, node)| self.label(node))
    }

    /// What a screen reader would read without a name: what may have the focus, pictures, gauges and bars.
    pub(crate) fn unnamed(&self) -> Vec<Role> {
        let seen = |node: &Node| {
            let shows = [Role::Image, Role::Meter, Role::ProgressIndicator];
            node.supports_action(Action::Focus) || shows.contains(&node.role())
        };
        let nodes = self.nodes.iter().map(|(_, node)| node);
        let nameless = nodes.filter(|node| seen(node) && self.label(node).trim().is_empty());
        nameless.map(Node::role).collect()
    }

    fn find(&self, role: Role, label: &str) -> Option<&Node> {
        let nodes = self.nodes.iter().map(|(_, node)| node);
        let mut nodes = nodes.filter(|node| node.role() == role);
        nodes.find(|node| self.label(node) == label)
    }

    /// The label of a node: its own, or that of the node that labels it.
    fn label<'n>(&'n self, node: &'n Node) -> &'n str {
        let by = node.labelled_by().first();
        let labels = self.nodes.iter().find(|(id, _)| Some(id) == by);
        let label = labels.map_or(node, |(_, node)| node);
        label.label().or(label.value()).unwrap_or_default()
    }

    /// Whether there is a node with this role and label.
    pub(crate) fn has(&self, role: Role, label: &str) -> bool {
        self.find(role, label).is_some()
    }

    /// Roles and labels of all nodes.
    pub(crate) fn labels(&self) -> Vec<(Role, String)> {
        let own = |(_, node): &(NodeId, Node)| (node.role(), self.label(node).to_owned());
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
        let button = |pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.events.push(button(true));
        self.later.push(button(false));
    }

    /// Presses a key.
    pub(crate) fn press(&mut self, key: Key) {
        self.press_with(key, Modifiers::NONE);
    }

    /// Presses a key while others are held.
    pub(crate) fn press_with(&mut self, key: Key, modifiers: Modifiers) {
        for pressed in [true, false] {
            self.events.push(Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers,
            });
        }
    }
}
