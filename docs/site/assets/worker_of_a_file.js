// A page that was opened from a disk may start no worker: the script of the search runs in a hidden frame instead, which gets
// and gives messages as a worker does.
window.Worker = class extends EventTarget {
  constructor(address) {
    super();
    const frame = document.createElement("iframe");
    frame.hidden = true;
    document.body.appendChild(frame);
    this.window = frame.contentWindow;
    this.loaded = new Promise(resolve => {
      const script = frame.contentDocument.createElement("script");
      this.window.postMessage = message => this.dispatchEvent(new MessageEvent("message", {data: message}));
      this.window.importScripts = () => {};  // only languages other than English need more
      script.src = address;
      script.onload = resolve;
      frame.contentDocument.body.appendChild(script);
    });
  }
  postMessage(message) {
    this.loaded.then(() => this.window.dispatchEvent(new MessageEvent("message", {data: message})));
  }
  terminate() {}
};
