// The first screen's tabs and its buttons that copy, and the bar of sections.

/** Remembers the engine that was chosen; a page opened from a file may have no storage. */
const chosenEngine = {
  key: "gnomon.engine",
  get() {
    try {
      return localStorage.getItem(this.key);
    } catch {
      return null;
    }
  },
  set(name) {
    try {
      localStorage.setItem(this.key, name);
    } catch {
      // The choice lasts as long as the page.
    }
  },
};

/** Copies the text; where the clipboard is closed to the page, selects it for Ctrl+C. */
async function copyText(code, copyButton) {
  try {
    await navigator.clipboard.writeText(code.textContent);
    copyButton.textContent = "Copied";
  } catch {
    getSelection().selectAllChildren(code);
    copyButton.textContent = "Press Ctrl+C";
  }
  setTimeout(() => {
    copyButton.textContent = "Copy";
  }, 1500);
}

function addCopyButton(block) {
  const code = block.querySelector("code");
  const copyButton = button("Copy", () => copyText(code, copyButton), { class: "copy" });
  block.before(copyButton);
}

/** Turns panels below each other into tabs, of which one is shown. */
class Tabs {
  /** @param {HTMLElement} host  has the panels as its children */
  constructor(host) {
    this.panels = [...host.children];
    this.tabs = this.panels.map((panel) => this.makeTab(panel));
    this.bar = element("div", { class: "tabs", role: "tablist", "aria-label": "Settings of" }, ...this.tabs);
    this.bar.addEventListener("keydown", (event) => this.key(event));
    host.prepend(this.bar);
    const remembered = this.panels.findIndex(({ dataset }) => dataset.name === chosenEngine.get());
    this.choose(Math.max(0, remembered));
  }

  makeTab(panel) {
    panel.id ||= freshId("panel");
    panel.setAttribute("role", "tabpanel");
    panel.querySelector("h3").hidden = true;
    const tab = button(panel.dataset.title, () => this.choose(this.tabs.indexOf(tab)), {
      role: "tab",
      id: freshId("tab"),
      "aria-controls": panel.id,
    });
    panel.setAttribute("aria-labelledby", tab.id);
    return tab;
  }

  choose(index) {
    this.chosen = index;
    this.tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === index));
      tab.tabIndex = i === index ? 0 : -1;
      this.panels[i].hidden = i !== index;
    });
    chosenEngine.set(this.panels[index].dataset.name);
  }

  key(event) {
    const last = this.tabs.length - 1;
    const next = {
      ArrowRight: this.chosen === last ? 0 : this.chosen + 1,
      ArrowLeft: this.chosen === 0 ? last : this.chosen - 1,
      Home: 0,
      End: last,
    }[event.key];
    if (next !== undefined) {
      event.preventDefault();
      this.choose(next);
      this.tabs[next].focus();
    }
  }
}

/** Lists in the bar the sections that are shown, in the page's order. */
function listSections() {
  const sections = [...document.querySelectorAll("main section[data-nav]:not([hidden])")];
  document.querySelector("nav.sections .links").replaceChildren(
    ...sections
      .filter(({ id }) => id !== "answer")
      .map(({ id, dataset }) => element("a", { href: `#${id}`, text: dataset.nav })),
  );
}

function openFirstScreen() {
  document.querySelectorAll("main pre").forEach(addCopyButton);
  const panels = document.querySelector(".panels");
  if (panels !== null && panels.children.length > 1) {
    new Tabs(panels);
  }
}
