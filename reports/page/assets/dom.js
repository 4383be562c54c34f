// Elements of the page. Texts go in as texts: names come from scenes that anybody may have written.

/**
 * @param {string} tag
 * @param {object} attributes  by name; "text" is the text, "on" an object of listeners; null leaves
 *     an attribute out
 * @param {...(Node|string)} children
 * @return {HTMLElement}
 */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") {
      made.textContent = value;
    } else if (name === "on") {
      Object.entries(value).forEach(([event, listener]) => made.addEventListener(event, listener));
    } else if (value !== null && value !== false) {
      made.setAttribute(name, value === true ? "" : String(value));
    }
  }
  made.append(...children);
  return made;
}

let lastId = 0;

/** An id that no other element has. */
function freshId(stem) {
  lastId += 1;
  return `${stem}-${lastId}`;
}

/** A name from a scene or a file: isolated from the text around it, cut where it is long. */
function nameElement(name, tag = "span") {
  return element(tag, { class: "name", title: name.length > 24 ? name.slice(0, 1000) : null, text: name });
}

const breakableParts = /[^._]*[._]|[^._]+/g;

/** A name such as "shadow_map.resolution", which may break behind its dots and underscores. */
function breakable(name) {
  return name.match(breakableParts).flatMap((part, i) => (i === 0 ? [part] : [element("wbr"), part]));
}

/** A control with its label before it. */
function labelled(text, control, className = "control") {
  control.id ||= freshId("control");
  return element("div", { class: className }, element("label", { for: control.id, text }), control);
}

/**
 * A choice among options.
 * @param {[string, string][]} options  value and text
 * @param {string} chosen  a value
 * @param {function(string)} onChange
 */
function choice(options, chosen, onChange) {
  const select = element("select", { on: { change: () => onChange(select.value) } });
  select.append(...options.map(([value, text]) => element("option", { value, text })));
  select.value = chosen;
  return select;
}

/** A button; `onClick` gets the event. */
function button(text, onClick, attributes = {}) {
  return element("button", { type: "button", text, on: { click: onClick }, ...attributes });
}

/** Replaces all but the heading of a section. */
function refill(section, ...children) {
  const heading = section.querySelector(":scope > h2");
  section.replaceChildren(...(heading === null ? [] : [heading]), ...children);
}

/** A wide thing that scrolls sideways by itself, by keyboard too. */
function scroller(label, child) {
  return element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": label }, child);
}

/** Runs a listener at most once a frame, with the last arguments. */
function oncePerFrame(action) {
  let latest = null;
  return (...values) => {
    if (latest === null) {
      requestAnimationFrame(() => {
        const given = latest;
        latest = null;
        action(...given);
      });
    }
    latest = values;
  };
}
