//! The page: form, script, and the program in it.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use charts::{HAND, Script, faults, scripted};
use flate2::{Compression, GzBuilder};
use maud::{PreEscaped, html};
use proof::Failure;

const BODY: &str = include_str!("../../../crates/web/page/body.html");
const STYLE: &str = include_str!("../../../crates/web/page/page.css");
const SCRIPT: &str = include_str!("../../../crates/web/page/page.js");
/// Beside the script: the module is compiled, a second thread is made of the script, pictures come as texts.
const PERMISSIONS: &str = " 'wasm-unsafe-eval'; worker-src blob:; img-src data:";

/// The page with the module in it.
pub(super) fn page(module: &[u8]) -> Result<String, Failure> {
    let mut packed = GzBuilder::new().write(Vec::new(), Compression::best());
    packed.write_all(module)?;
    let packed = STANDARD.encode(packed.finish()?);
    let page = with(&packed);
    // letters of the module would be taken for words
    let faults = faults(&with(""));
    if faults.is_empty() { Ok(page) } else { Err(Failure(format!("the page: {}", faults.join("; ")))) }
}

fn with(packed: &str) -> String {
    let lead = html! {
        p {
            "fogcoil in this page: the thermal bias of a fibre-optic gyroscope's coil, computed on your machine. Nothing is sent, and nothing is installed. The numbers are \
             those of the program."
        }
    };
    let body = html! { (PreEscaped(BODY)) template id="program" { (packed) } };
    scripted("Try fogcoil", &lead, &body, Script { text: &format!("{HAND}{SCRIPT}"), style: STYLE, permissions: PERMISSIONS })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_whole_and_holds_its_module() {
        let text = page(b"\0asm").unwrap();
        let (_, rest) = text.split_once("<template id=\"program\">").unwrap();
        let packed = STANDARD.decode(rest.split('<').next().unwrap()).unwrap();
        let mut module = Vec::new();
        std::io::Read::read_to_end(&mut flate2::read::GzDecoder::new(packed.as_slice()), &mut module).unwrap();
        assert_eq!(module, b"\0asm");
        // every element that the script names is there
        let named = SCRIPT.split("at('").skip(1).filter_map(|rest| rest.split('\'').next());
        for id in named {
            assert!(text.contains(&format!("id=\"{id}\"")), "{id}");
        }
    }
}
