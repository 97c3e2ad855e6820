use super::Markup;
use crate::plot::{Draw, Plot};

/// The style of all pages.
const STYLE: &str = include_str!("style.css");

/// A whole page.
#[derive(Debug, Clone)]
pub(crate) struct Page {
    pub(crate) title: String,
    /// Under the title.
    pub(crate) summary: Markup,
    pub(crate) body: Markup,
    /// At the end, small.
    pub(crate) footer: Markup,
}

impl Page {
    /// The text of its file.
    pub(crate) fn html(&self) -> String {
        let title = Markup::from(&*self.title);
        let header = Markup::plain("h1", &*self.title).and(self.summary.clone());
        let header = Markup::of_class("header", "page", header);
        let main = Markup::plain("main", self.body.clone());
        let foot = Markup::plain("footer", self.footer.clone());
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n\
             <meta charset=\"utf-8\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{header}\n{main}\n{foot}\n\
             </body>\n</html>\n"
        )
    }
}

/// A plot with its title above and its caption below.
pub(crate) fn figure(plot: &Plot, caption: impl Into<Markup>) -> Markup {
    let title = Markup::plain("h4", &*plot.title);
    let caption = Markup::plain("figcaption", caption);
    let drawn = Markup::drawn(plot.svg());
    Markup::plain("figure", title.and(drawn).and(caption))
}
