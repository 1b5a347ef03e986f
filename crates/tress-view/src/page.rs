//! Pictures, plots and tables on one page of HTML that needs no other file.

use std::fmt::Write as _;

/// A page under way, written from top to bottom.
///
/// ```
/// use tress_view::Page;
///
/// let mut page = Page::new("A groom of <coils>");
/// page.heading("In numbers");
/// page.table(&["quantity", "median"], &[vec!["turns".into(), "23.1".into()]]);
/// let html = page.finish();
/// assert!(html.starts_with("<!DOCTYPE html>") && html.contains("<td>23.1</td>"));
/// assert!(html.contains("A groom of &lt;coils&gt;"));
/// ```
#[derive(Clone, Debug)]
pub struct Page {
    html: String,
    /// Whether figures are being laid side by side.
    in_figures: bool,
}

const STYLE: &str = "\
:root{--ink:#2a2826;--soft:#6d6862;--line:#ddd8d0;--paper:#fbfaf8;--panel:#fff;--accent:#1f628e}\
*{box-sizing:border-box}\
body{margin:0 auto;padding:2.5rem 1.5rem 4rem;max-width:1280px;background:var(--paper);\
color:var(--ink);font:16px/1.5 system-ui,'Segoe UI',Ubuntu,sans-serif}\
h1{font-weight:300;font-size:2.1rem;margin:0 0 .3rem}\
h2{font-weight:400;font-size:1.3rem;margin:2.6rem 0 .8rem;padding-bottom:.35rem;\
border-bottom:1px solid var(--line);color:var(--accent)}\
p{max-width:75ch;margin:.4rem 0}.soft{color:var(--soft)}\
.warn{background:#fdf1e3;border-left:4px solid #c85c22;padding:.5rem .9rem;margin:.5rem 0}\
.good{background:#eef5ee;border-left:4px solid #4c8a55;padding:.5rem .9rem;margin:.5rem 0}\
table{border-collapse:collapse;background:var(--panel);border:1px solid var(--line);\
font-variant-numeric:tabular-nums}\
th,td{padding:.35rem .9rem;text-align:right;border-bottom:1px solid var(--line)}\
th{font-weight:500;color:var(--soft)}th:first-child,td:first-child{text-align:left}\
tr:last-child td{border-bottom:0}.scroll{overflow-x:auto}\
.figures{display:grid;gap:1.2rem;\
grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr))}\
figure{margin:0;background:var(--panel);border:1px solid var(--line);padding:.7rem;min-width:0}\
figure svg,figure img{display:block;width:100%;height:auto}\
figcaption{font-size:.88rem;color:var(--soft);padding:.5rem .2rem 0}";

impl Page {
    /// A page of this title.
    #[must_use]
    pub fn new(title: &str) -> Self {
        let title = escaped(title);
        let html = format!(
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
             <title>{title}</title><style>{STYLE}</style></head>\n<body><h1>{title}</h1>\n"
        );
        Self { html, in_figures: false }
    }

    /// What follows has this heading.
    pub fn heading(&mut self, text: &str) {
        self.block("h2", "", text);
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: &str) {
        self.block("p", "", text);
    }

    /// A paragraph of less weight.
    pub fn note(&mut self, text: &str) {
        self.block("p", "soft", text);
    }

    /// Something is wrong.
    pub fn warning(&mut self, text: &str) {
        self.block("div", "warn", text);
    }

    /// Nothing is wrong.
    pub fn good(&mut self, text: &str) {
        self.block("div", "good", text);
    }

    /// A table; rows may be shorter than the head.
    pub fn table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        self.end_figures();
        self.html.push_str("<div class=\"scroll\"><table><thead><tr>");
        for cell in head {
            let _ = write!(self.html, "<th>{}</th>", escaped(cell));
        }
        self.html.push_str("</tr></thead><tbody>\n");
        for row in rows {
            self.html.push_str("<tr>");
            for cell in row {
                let _ = write!(self.html, "<td>{}</td>", escaped(cell));
            }
            self.html.push_str("</tr>\n");
        }
        self.html.push_str("</tbody></table></div>\n");
    }

    /// An SVG drawing, as made by [`plot`](crate::plot); figures in a row stand side by side.
    pub fn svg(&mut self, svg: &str, caption: &str) {
        // Its size is that of its place: the viewBox keeps its proportions.
        let drawing = match svg.find("viewBox") {
            Some(at) => format!("<svg {}", &svg[at..]),
            None => svg.into(),
        };
        self.figure(&drawing, caption);
    }

    /// A PNG file.
    pub fn png(&mut self, bytes: &[u8], caption: &str) {
        let alt = escaped(caption);
        let data = base64(bytes);
        self.figure(&format!("<img alt=\"{alt}\" src=\"data:image/png;base64,{data}\">"), caption);
    }

    /// The page.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.end_figures();
        self.html.push_str("</body></html>\n");
        self.html
    }

    fn figure(&mut self, inner: &str, caption: &str) {
        if !self.in_figures {
            self.html.push_str("<div class=\"figures\">\n");
            self.in_figures = true;
        }
        let caption = escaped(caption);
        let _ = writeln!(self.html, "<figure>{inner}<figcaption>{caption}</figcaption></figure>");
    }

    fn block(&mut self, tag: &str, class: &str, text: &str) {
        self.end_figures();
        let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
        let _ = writeln!(self.html, "<{tag}{class}>{}</{tag}>", escaped(text));
    }

    fn end_figures(&mut self) {
        if std::mem::take(&mut self.in_figures) {
            self.html.push_str("</div>\n");
        }
    }
}

/// Text that is neither tag nor entity.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Base 64 of RFC 4648, padded.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * i)) as usize & 63];
            text.push(if i <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        let cases =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg==")];
        for (text, encoded) in cases {
            assert_eq!(base64(text.as_bytes()), encoded);
        }
        assert_eq!(base64(&[255, 254, 253]), "//79");
    }

    #[test]
    fn figures_stand_together_and_all_tags_are_closed() {
        let mut page = Page::new("a & b");
        page.svg("<svg width=\"9\" viewBox=\"0 0 9 9\"></svg>", "one");
        page.png(&[1, 2, 3], "two \"quoted\"");
        page.warning("<careful>");
        page.svg("<svg></svg>", "three");
        let html = page.finish();
        assert_eq!(html.matches("class=\"figures\"").count(), 2);
        for tag in ["div", "figure", "figcaption", "svg", "body", "html", "style"] {
            let open = html.matches(&format!("<{tag}")).count();
            assert!(open >= html.matches(&format!("</{tag}>")).count(), "{tag}");
        }
        assert_eq!(html.matches("<div").count(), html.matches("</div>").count());
        assert!(html.contains("&lt;careful&gt;") && html.contains("a &amp; b"));
        assert!(!html.contains("http"), "nothing is fetched");
    }
}
