/** Unpacks the viewer and runs it: a script element whose text has the fingerprint that the page's policy allows, so that nothing is evaluated. */
import { byId } from "./dom";

async function unpacked(id: string): Promise<string> {
  const bytes = Uint8Array.from(atob(byId(id).textContent ?? ""), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
}

unpacked("viewer").then(
  (text) => {
    const script = document.createElement("script");
    script.textContent = text;
    document.head.append(script);
  },
  (error: unknown) => {
    const box = byId("failure");
    box.hidden = false;
    box.textContent = `This browser cannot unpack the report; it needs Chromium 103, Firefox 113, Safari 16.4 or a newer one (${error}).`;
  },
);
