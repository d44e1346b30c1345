"use strict";
// What the page holds deflated: the library that draws the charts, and the numbers of all pictures.

/** The bytes of a text in base 64, inflated. */
async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate")));
}

/** Run the library, off the page's own address: a browser compiles it beside the page, which is on the screen already. */
async function loadLibrary() {
  const code = await (await inflated(byId("library").textContent)).blob();
  const script = element("script", { src: URL.createObjectURL(code) });
  await new Promise((resolve, reject) => {
    Object.assign(script, { onload: resolve, onerror: reject });
    document.head.append(script);
  });
  URL.revokeObjectURL(script.src);
  byId("library").remove();
}

/** The numbers of all pictures: their bytes joined, their differences summed. */
async function unpack(text) {
  const bytes = new Uint8Array(await (await inflated(text)).arrayBuffer());
  const count = bytes.length / 2;
  const numbers = new Uint16Array(count);
  for (let place = 0, last = 0; place < count; place += 1) {
    last = (last + (bytes[place] << 8) + bytes[count + place]) & 65535;
    numbers[place] = last;
  }
  return numbers;
}
