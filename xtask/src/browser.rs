//! Headless Chromium over its debugging pipe: messages of JSON, each ended by a zero byte, on its descriptors 3 and 4.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use proof::Failure;

/// Names under which Chromium is looked for, after $CHROMIUM.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
const PATIENCE: Duration = Duration::from_secs(120);

/// A browser with one tab; it ends with this value.
pub(crate) struct Browser {
    child: Child,
    to: ChildStdin,
    from: Receiver<Value>,
    session: Option<String>,
    sent: u64,
    events: Vec<Value>,
    pub(crate) version: String,
}

/// The command that starts Chromium.
pub(crate) fn find() -> Result<String, Failure> {
    let starts = |name: &str| {
        Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
    };
    let named = std::env::var("CHROMIUM").ok();
    let found = named.iter().map(String::as_str).chain(NAMES).find(|name| starts(name)).map(str::to_owned);
    found.ok_or_else(|| {
        Failure(format!("no Chromium is found as {}; install one, or name it in the variable CHROMIUM", NAMES.join(", ")))
    })
}

impl Browser {
    /// Starts `chromium` with a fresh profile in `profile`.
    pub(crate) fn launch(chromium: &str, profile: &Path) -> Result<Self, Failure> {
        #[rustfmt::skip]
        let flags = [
            "--remote-debugging-pipe", "--disable-background-networking", "--headless=new", "--no-sandbox", "--disable-gpu",
            "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars",
        ];
        let mut child = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 1>&2", chromium])
            .args(flags)
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg("about:blank")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let (Some(to), Some(out)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(Failure("Chromium has no pipes".into()));
        };
        let (sender, from) = channel();
        std::thread::spawn(move || {
            let messages = BufReader::new(out).split(0).map_while(Result::ok);
            let parsed = messages.filter_map(|message| serde_json::from_slice::<Value>(&message).ok());
            parsed.take_while(|message| sender.send(message.clone()).is_ok()).for_each(drop);
        });
        let mut browser = Self { child, to, from, session: None, sent: 0, events: Vec::new(), version: String::new() };
        browser.version = text(&browser.call("Browser.getVersion", json!({}))?, "product");
        let target = text(&browser.call("Target.createTarget", json!({ "url": "about:blank" }))?, "targetId");
        let attached = browser.call("Target.attachToTarget", json!({ "targetId": target, "flatten": true }))?;
        browser.session = Some(text(&attached, "sessionId"));
        for domain in ["Page.enable", "Runtime.enable", "Log.enable", "Network.enable"] {
            browser.call(domain, json!({}))?;
        }
        Ok(browser)
    }

    /// Sends a command and waits for its answer.
    pub(crate) fn call(&mut self, method: &str, params: Value) -> Result<Value, Failure> {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let mut bytes = serde_json::to_vec(&message)?;
        bytes.push(0);
        self.to.write_all(&bytes)?;
        self.to.flush()?;
        let id = self.sent;
        let answer = self.wait(method, |m| m["id"] == id)?;
        match answer.get("error") {
            Some(error) => Err(Failure(format!("Chromium refuses {method}: {}", error["message"]))),
            None => Ok(answer["result"].clone()),
        }
    }

    /// Waits for an event, which may have come already.
    pub(crate) fn until(&mut self, event: &str) -> Result<(), Failure> {
        if self.events.iter().any(|e| e["method"] == event) {
            return Ok(());
        }
        let found = self.wait(event, |m| m["method"] == event)?;
        self.events.push(found);
        Ok(())
    }

    /// The first message that is `wanted`; events before it are kept.
    fn wait(&mut self, what: &str, wanted: impl Fn(&Value) -> bool) -> Result<Value, Failure> {
        let start = Instant::now();
        loop {
            let left = PATIENCE.saturating_sub(start.elapsed());
            let message = self.from.recv_timeout(left).map_err(|e| Failure(format!("Chromium does not answer ({what}): {e}")))?;
            if wanted(&message) {
                return Ok(message);
            }
            if message.get("method").is_some() {
                self.events.push(message);
            }
        }
    }

    /// Opens a page and waits until it is there; only what happens from then on is among the events.
    pub(crate) fn open(&mut self, url: &str) -> Result<(), Failure> {
        self.events();
        let answer = self.call("Page.navigate", json!({ "url": url }))?;
        match answer["errorText"].as_str() {
            Some(error) => Err(Failure(format!("{url}: {error}"))),
            None => self.until("Page.loadEventFired"),
        }
    }

    /// The events since the last call of this.
    pub(crate) fn events(&mut self) -> Vec<Value> {
        std::mem::take(&mut self.events)
    }

    /// Value of an expression in the page; a promise is awaited.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Result<Value, Failure> {
        let params = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", params)?;
        match answer.get("exceptionDetails") {
            Some(details) => Err(Failure(format!("the page's check fails: {}", details["exception"]["description"]))),
            None => Ok(answer["result"]["value"].clone()),
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // one that is gone already needs no end
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or_default().to_owned()
}

/// An error or a warning of the console.
pub(crate) fn complaint(event: &Value) -> Option<String> {
    let params = &event["params"];
    match event["method"].as_str()? {
        "Runtime.exceptionThrown" => Some(params["exceptionDetails"]["text"].to_string()),
        "Runtime.consoleAPICalled" if params["type"] != "log" => Some(params["args"].to_string()),
        "Log.entryAdded" if params["entry"]["level"] != "verbose" => Some(params["entry"]["text"].to_string()),
        _ => None,
    }
}

/// An address that was asked of the network or the disk.
pub(crate) fn request(event: &Value) -> Option<String> {
    (event["method"] == "Network.requestWillBeSent")
        .then(|| event["params"]["request"]["url"].as_str().unwrap_or_default().to_owned())
}
