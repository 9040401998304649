// What outlives the page, in the browser's own database: the last ten pieces of work as drafts, and for every tab its
// history of undo. Where there is no database (private windows, no permission, no room), nothing is kept, and the page
// works without.

const kDrafts = 10;
const kSessions = 8; // tabs whose undo is kept
const kSteps = 100; // of undo that are kept, of a document of ordinary size
const kElements = 200_000; // of the lists of all kept steps together: what is kept is copied whole at every edit
const kLongText = 64 << 10; // characters; a longer one is written anew from its document

const wait = (request) => new Promise((done, failed) => {
  request.onsuccess = () => done(request.result);
  request.onerror = () => failed(request.error);
});

let opened = null; // the promise of the database
function database() {
  opened ??= (async () => {
    const request = indexedDB.open("awan", 1);
    request.onupgradeneeded = () => {
      request.result.createObjectStore("drafts", { keyPath: "id" });
      request.result.createObjectStore("sessions", { keyPath: "tab" });
    };
    return wait(request);
  })();
  return opened;
}
const storeOf = async (name, mode) => (await database()).transaction(name, mode).objectStore(name);

async function put(name, record, most, keyOf) {
  const store = await storeOf(name, "readwrite");
  store.put(record);
  const all = await wait(store.getAll());
  const oldest = all.sort((a, b) => b.time - a.time).slice(most);
  for (const one of oldest) store.delete(one[keyOf]);
}

// This tab's name, the same after a reload.
function tabName() {
  try {
    const known = sessionStorage.getItem("awan.tab");
    if (known) return known;
    const fresh = `${Date.now()}-${Math.random()}`;
    sessionStorage.setItem("awan.tab", fresh);
    return fresh;
  } catch {
    return null; // no permission
  }
}

function stepsKept(scene) {
  const clouds = Array.isArray(scene.clouds) ? scene.clouds : [scene];
  const lists = clouds.flatMap((cloud) => [cloud?.cubes, cloud?.positions, cloud?.radii].filter(Array.isArray));
  const elements = lists.reduce((sum, list) => sum + list.length, 1);
  return Math.max(1, Math.min(kSteps, Math.floor(kElements / elements)));
}
const withoutLongText = (state) => (state.written?.length > kLongText ? { ...state, written: null } : state);

// store: the document (document.js). failed(error): told once when keeping does not work.
export function createKeeping(store, { failed = () => {} } = {}) {
  const tab = tabName();
  let busy = false;
  let again = false;
  let broken = false;

  // A preset as it ships is no work of anybody's.
  async function write() {
    const { state, past, future } = store.history(stepsKept(store.scene));
    const time = Date.now();
    const mine = withoutLongText(state);
    if (tab !== null) {
      const session = { tab, time, hash: location.hash, state: mine, past: past.map(withoutLongText), future: future.map(withoutLongText) };
      await put("sessions", session, kSessions, "tab");
    }
    if (!state.preset && state.work.id) {
      await put("drafts", { id: state.work.id, title: state.work.title, time, scene: mine.scene, written: mine.written }, kDrafts, "id");
    }
  }

  return {
    // The document as it is now. One write at a time; the last one is of the last state.
    async save() {
      if (broken) return;
      again = true;
      if (busy) return;
      busy = true;
      try {
        while (again) {
          again = false;
          await write();
        }
      } catch (error) {
        broken = true;
        failed(error);
      } finally {
        busy = false;
      }
    },
    // [{ id, title, time, scene, written }], the latest first.
    async drafts() {
      try {
        return (await wait((await storeOf("drafts", "readonly")).getAll())).sort((a, b) => b.time - a.time);
      } catch {
        return [];
      }
    },
    async forget(id) {
      await wait((await storeOf("drafts", "readwrite")).delete(id));
    },
    // A draft that was forgotten, as it was.
    async restore(draft) {
      await put("drafts", draft, kDrafts, "id");
    },
    // What this tab had on the page before it was loaded again; null where it was at another address, or never here.
    async session() {
      try {
        const found = tab === null ? undefined : await wait((await storeOf("sessions", "readonly")).get(tab));
        return found?.hash === location.hash ? found : null;
      } catch {
        return null;
      }
    },
  };
}
