// A scene in an address: gzipped, in the fragment, which browsers keep to themselves. "#s=" and base64 with the two
// characters that addresses have no trouble with (RFC 4648, 5).

const MARK = "#s=";
const kLongestLink = 1_000_000; // characters; browsers take about twice as many, few other programs do
const kLongestText = 32 << 20; // a small fragment could hold a text that fills the memory

const piped = (bytes, through) => new Blob([bytes]).stream().pipeThrough(through);

export const isShared = (hash) => hash.startsWith(MARK);

// Throws RangeError when the scene is too long for an address.
export async function linkTo(text, base) {
  const bytes = new Uint8Array(await new Response(piped(text, new CompressionStream("gzip"))).arrayBuffer());
  let letters = "";
  for (let i = 0; i < bytes.length; i += 0x8000) letters += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  const link = base + MARK + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  if (link.length > kLongestLink) {
    throw new RangeError(`This scene would make an address of ${link.length.toLocaleString("en")} characters: save it as a file instead.`);
  }
  return link;
}

// The text of the scene in a fragment. Throws Error when there is none that can be read.
export async function sharedText(hash) {
  try {
    const letters = atob(hash.slice(MARK.length).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const reader = piped(bytes, new DecompressionStream("gzip")).getReader();
    const decoder = new TextDecoder("utf-8", { fatal: true });
    let text = "";
    for (let read = await reader.read(); !read.done; read = await reader.read()) {
      text += decoder.decode(read.value, { stream: true });
      if (text.length > kLongestText) throw new RangeError();
    }
    return text + decoder.decode();
  } catch {
    throw new Error("The scene in this address cannot be read: the address may be cut off.");
  }
}
