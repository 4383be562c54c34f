// Goes from one cluster of wrong pixels to the next.

/** Buttons for the next and the previous error, and a line that says which one is shown. */
class ErrorNavigation {
  /** @param {function(Int32Array)} onCluster  told the pixels to show */
  constructor(onCluster) {
    this.onCluster = onCluster;
    this.text = element("p", { class: "error-text screen", role: "status" });
    this.buttons = element(
      "div",
      { class: "buttons", role: "group", "aria-label": "Errors" },
      button("Previous error", () => this.go(-1)),
      button("Next error", () => this.go(1)),
    );
  }

  /** Starts anew, with the largest cluster at a bias; clusters are found when they are asked for. */
  restart(causes, bias) {
    const saysHint = this.clusters === null; // a screen reader need not hear it again
    Object.assign(this, { causes, bias, clusters: null, place: -1 });
    if (saysHint) {
      return;
    }
    const hint = "Go from one cluster of wrong pixels to the next, the largest first (keys n and p on the picture).";
    this.text.replaceChildren(element("span", { class: "hint", text: hint }));
  }

  /** @param {number} step  1 for the next error, -1 for the previous one; after the last one comes the first */
  go(step) {
    const { causes, bias } = this;
    this.clusters ??= errorClusters(causes.image, bias);
    const count = this.clusters.length;
    if (count === 0) {
      this.text.textContent = "No pixel is wrong at this bias.";
      return;
    }
    this.place = this.place < 0 && step < 0 ? count - 1 : (this.place + step + count) % count;
    const pixels = this.clusters[this.place];
    const { text, object } = describeCluster(causes, pixels, bias);
    this.text.replaceChildren(
      `Error ${grouped(this.place + 1)} of ${grouped(count)}: ${text}`,
      ...(object === null ? [] : [" on ", nameElement(object)]),
    );
    this.onCluster(pixels);
  }
}
