"""Asks a running server for everything that its /openapi.json says, in the manner of schemathesis.

  openapi.py AWAN [SCENES [SEED]]     the program; random scenes a route (default 25); the seed of chance (default 1)

Valid requests, made from the schemas: an answer whose status, type, headers and JSON are declared, never 500 or 503. Each
constraint of a schema broken by itself: 4xx, a problem document whose pointer names the place. Methods, paths and types that
are not declared: 405 with Allow, 404, 415, 406.
"""
import copy
import json
import random
import re
import sys
import time
import urllib.parse

import jsonschema

from serving import JSON, SCENE, Checks, Server

AWAN = sys.argv[1]
SCENES = int(sys.argv[2]) if len(sys.argv) > 2 else 25
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
METHODS = ["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE"]
# Headers that every answer may have: HTTP's own, and what openapi.json says of all answers.
EVERYWHERE = {"date", "content-type", "content-length", "transfer-encoding", "connection", "cache-control", "x-request-id",
              "x-content-type-options", "content-encoding", "content-security-policy", "referrer-policy"}
# What costs time: kept small, whatever the schema allows.
SMALL = {"particles": 30, "width": 24, "height": 16, "frames": 2, "steps": 4, "resolution": 20, "levels": 3, "count": 4,
         "clusters": 2, "ellipsoids": 3, "history": 2, "octaves": 3}

check = Checks()


class Contract:
    def __init__(self, document):
        self.document = document
        # The keys of a schema with references into the document.
        self.whole = {"components": document["components"]}

    def found(self, node):
        while "$ref" in node:
            place = self.document
            for part in node["$ref"].removeprefix("#/").split("/"):
                place = place[part]
            node = place
        return node

    def errors(self, schema, value):
        validator = jsonschema.Draft202012Validator({**self.whole, **schema})
        return [error.message[:200] for error in validator.iter_errors(value)]


def number(schema, chance):
    low = schema.get("minimum", schema.get("exclusiveMinimum", -10))
    high = schema.get("maximum", 100)
    if schema["type"] == "integer":
        value = chance.choice([low, min(low + 1, high), chance.randint(low, min(high, low + 20))])
        return value - value % schema.get("multipleOf", 1)
    value = chance.choice([1.0, chance.uniform(0, 2), chance.uniform(-5, 5)])
    value = min(max(value, low), high)
    return value if value != schema.get("exclusiveMinimum") else min(low + 0.5, high)


class Maker:
    """Values of a schema by chance."""

    def __init__(self, contract, chance):
        self.contract, self.chance = contract, chance

    def value(self, schema, name="", depth=0):
        schema, chance = self.contract.found(schema), self.chance
        if "default" in schema and chance.random() < 0.3:
            return schema["default"]
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return chance.choice(schema["enum"])
        for word in ("oneOf", "anyOf"):
            if word in schema and "properties" not in schema:
                return self.value(chance.choice(schema[word]), name, depth)
        kind = schema.get("type")
        if kind == "object":
            return self.object(schema, depth)
        if kind == "array":
            least, most = schema.get("minItems", 0), schema.get("maxItems", 3)
            count = chance.randint(least, max(least, min(most, 2)))
            return [self.value(schema["items"], name, depth + 1) for _ in range(count)]
        if kind in ("number", "integer"):
            value = number(schema, chance)
            return min(value, max(SMALL[name], schema.get("minimum", 0))) if name in SMALL else value
        if kind == "boolean":
            return chance.random() < 0.5
        if kind == "string":
            return schema.get("default", schema.get("examples", ["a"])[0])
        return None

    def object(self, schema, depth):
        required = set(schema.get("required", []))
        if "oneOf" in schema:
            required |= set(self.chance.choice(schema["oneOf"])["required"])
        excluded = {key for one in schema.get("oneOf", []) for key in one["required"]} - required
        properties = schema.get("properties", {})
        names = [name for name in properties if name in required]
        others = [name for name in properties if name not in required | excluded]
        most = schema.get("maxProperties", 3)
        wanted = self.chance.randint(schema.get("minProperties", 0), min(most, 3))
        names += self.chance.sample(others, min(wanted, len(others)))
        return {name: self.value(properties[name], name, depth + 1) for name in names}

    def scene(self):
        kind = self.chance.choice(["Scene", "Scene", "SceneOfParticles"])
        scene = self.object(self.contract.found({"$ref": "#/components/schemas/" + kind}), 0)
        image = scene.get("image")
        scene["image"] = {**(image if isinstance(image, dict) else {}), "width": 16, "height": 12}
        # Thick clouds and their lumps take the truth long.
        scene.setdefault("density", 0.2)
        scene.setdefault("detail", "none")
        scene["accuracy"] = {"rung": self.chance.choice(["harris", "additive", "transport-16"])}
        return scene


def escaped(name):
    return "/" + str(name).replace("~", "~0").replace("/", "~1")


class Breaker:
    """Walks a schema beside a small valid value of it, and yields (the document broken in one place, pointer, what)."""

    def __init__(self, contract, document, whole):
        self.contract, self.document, self.whole = contract, document, whole
        # Each schema by name once.
        self.seen = set()

    def put(self, path, value):
        document = copy.deepcopy(self.document)
        place = document
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = value
        return document

    def walk(self, schema, path, companions=None):
        """companions: the object's other members where `path` leads."""
        name = schema.get("$ref")
        if name in self.seen:
            return
        if name:
            self.seen.add(name)
        schema = self.contract.found(schema)
        if schema.get("type") == "object":
            yield from self.of_object(schema, path)

    def of_object(self, schema, path):
        base = self.document
        for key in path:
            base = base[key]
        pointer = "".join(map(escaped, path))
        yield self.changed(path, {**base, "no_such_field": 1}), pointer + "/no_such_field", "unknown member"
        for name in schema.get("required", []):
            if name in ("cubes", "clouds", "model"):
                continue
            less = {key: value for key, value in base.items() if key != name}
            yield self.changed(path, less), pointer + escaped(name), "required member left out"
        for name, member in schema["properties"].items():
            # Of what is not read, nothing is wrong.
            if set(member) <= {"description"}:
                continue
            for value, what in self.wrong(member):
                yield self.changed(path, {**base, name: value}), pointer + escaped(name), what

    def changed(self, path, value):
        return self.put(path, value) if path else value

    def wrong(self, schema):
        """Values that this schema does not allow, whatever stands around them."""
        kinds = [self.contract.found(one) for one in self.alternatives(schema)]
        types = {kind.get("type") for kind in kinds}
        yield None, "null"
        if "object" not in types:
            yield {"no": 1}, "an object"
        if "array" not in types:
            yield [1, 2], "an array"
        if "boolean" not in types:
            yield True, "a boolean"
        if "string" not in types or all("enum" in kind or "pattern" in kind for kind in kinds if kind.get("type") == "string"):
            yield "no such word", "a word"
        for kind in kinds:
            if kind.get("type") in ("number", "integer") and len(types) == 1 and "const" not in kind:
                if "minimum" in kind and "anyOf" not in schema:
                    yield kind["minimum"] - max(1, abs(kind["minimum"])), "below its minimum"
                if "exclusiveMinimum" in kind and "anyOf" not in schema:
                    yield kind["exclusiveMinimum"], "its exclusive minimum"
                if "maximum" in kind:
                    yield kind["maximum"] * 2 + 1, "above its maximum"
                if kind["type"] == "integer":
                    yield kind.get("minimum", 0) + 0.5, "no integer"
        if types == {"array"}:
            kind = kinds[0]
            item = self.contract.found(kind["items"])
            if kind.get("minItems", 0) > 0 and item.get("type") == "number":
                yield [1] * (kind["minItems"] - 1), "too few items"
            if kind.get("maxItems", 1 << 20) <= 10 and item.get("type") == "number":
                yield [1] * (kind["maxItems"] + 1), "too many items"

    def alternatives(self, schema):
        schema = self.contract.found(schema)
        for word in ("oneOf", "anyOf"):
            if word in schema and "properties" not in schema:
                return [inner for one in schema[word] for inner in self.alternatives(one)]
        return [schema]


def declared(contract, operation, answer, what, head=False):
    """The answer is one that the operation declares."""
    responses = operation["responses"]
    if not check.that(str(answer.status) in responses, "a status that is not declared", answer.status, what):
        return
    response = contract.found(responses[str(answer.status)])
    names = {name.lower() for name in response.get("headers", {})} | EVERYWHERE
    check.that(set(answer.headers) <= names, "a header that is not declared", sorted(set(answer.headers) - names), what)
    check.that("x-request-id" in answer.headers, "X-Request-Id", what)
    for name, header in response.get("headers", {}).items():
        header, said = contract.found(header), answer.headers.get(name.lower())
        if said is None:
            continue
        kind = contract.found(header["schema"]).get("type", "string")
        value = said if kind == "string" else json.loads(said)
        check.that(not contract.errors(header["schema"], value), "a header's value", name, said, what)
    content = response.get("content")
    if content is None:
        check.that(not answer.body, "a body that is not declared", what)
        return
    if not check.that(answer.type in content, "a type that is not declared", answer.type, what) or head:
        return
    if answer.type.endswith("json"):
        wrong = contract.errors(content[answer.type]["schema"], answer.json())
        check.that(not wrong, "JSON that its schema does not allow", wrong[:2], what)


def is_problem(answer, statuses, what, pointer=None):
    if not check.that(answer.status in statuses, f"not one of {statuses}", answer.status, answer.body[:200], what):
        return
    check.that(answer.type == "application/problem+json", "an error is a problem document", answer.type, what)
    document = answer.json()
    check.that(document["status"] == answer.status, "a problem says its status", what)
    if pointer is None:
        return
    said = document.get("pointer", "")
    # The place, what holds it, or what in it is wrong.
    near = said == pointer or said == pointer.rpartition("/")[0] or said.startswith(pointer + "/")
    check.that(near, "the pointer names the place", repr(said), "not", pointer, document["detail"][:150], what)


def named(path, job):
    return path.replace("{name}", "soft" if "textures" in path else "cumulus").replace("{id}", job)


def query_values(contract, parameter, chance):
    """(good, bad) values of a parameter of the query."""
    schema = contract.found(parameter["schema"])
    if "enum" in schema:
        return schema["enum"], ["no-such-word", ""]
    if schema["type"] in ("integer", "number"):
        good = [{"width": 20, "height": 12, "seed": 3, "error": 0.5, "time_ms": 5000, "radius": 0.5}.get(
            parameter["name"], schema.get("minimum", 1))]
        bad = ["x", "", "1e999", "nan", "1,5", "0x10"]
        if "minimum" in schema:
            bad.append(str(schema["minimum"] - 1))
        if "exclusiveMinimum" in schema:
            bad.append(str(schema["exclusiveMinimum"]))
        if "maximum" in schema:
            bad.append(str(schema["maximum"] + 1))
        if schema["type"] == "integer":
            bad.append("1.5")
        return good, bad
    return [], []


def try_posts(server, contract, path, operation, chance):
    """A route that takes scenes."""
    maker = Maker(contract, chance)
    body = contract.found(operation["requestBody"])
    slow = path == "/v1/accuracy"
    suffix = "?samples=2&size=16&runs=2" if slow else ""
    answers = {"application/json": json.dumps(SCENE), "text/x-awn": "20\n1\n20 2 1 2 0 0 0 .5\n",
               "text/x-awa": "awa 1\n20\n1\n20 2 1 2 0 0 0 .5 none\n",
               "text/csv": "x,y,z,radius\n0,0,0,1\n1,1,1,.5\n",
               "application/x-ply": "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                                    "property float z\nproperty float radius\nend_header\n0 0 0 1\n",
               "application/x-www-form-urlencoded": urllib.parse.urlencode({"scene": json.dumps(SCENE)}),
               "multipart/form-data": '--b\r\nContent-Disposition: form-data; name="scene"\r\n\r\n' +
                                      json.dumps(SCENE) + "\r\n--b--\r\n"}
    check.that(set(answers) == set(body["content"]), "the types of a scene", set(answers) ^ set(body["content"]))
    small = "image/" if path == "/v1/render" else ""
    for kind, text in answers.items():
        more = "; boundary=b" if kind.startswith("multipart") else ""
        query = suffix or ("?width=16&height=12&rung=harris" if small else "")
        answer = server.ask("POST", path + query, text, {"Content-Type": kind + more})
        check.that(answer.status == 200, "a body of each type", path, kind, answer.status, answer.body[:200])
        declared(contract, operation, answer, (path, kind))
    # Each type of the answer, by Accept.
    for kind in contract.found(operation["responses"]["200"])["content"]:
        answer = server.ask("POST", path + suffix, json.dumps(SCENE), {**JSON, "Accept": kind})
        check.that(answer.status == 200 and answer.type == kind, "an answer of each type", path, kind, answer.status)
        declared(contract, operation, answer, (path, kind))
    is_problem(server.ask("POST", path, "{}", {**JSON, "Accept": "video/mp4"}), {406}, (path, "Accept"))
    for kind in ("text/plain", "application/xml", "image/png", "", "application/json; charset=latin1", "json"):
        is_problem(server.ask("POST", path, "{}", {"Content-Type": kind}), {415}, (path, kind))
    for encoding in ("br", "deflate", "gzip, gzip", "nonsense"):
        is_problem(server.ask("POST", path, "{}", {**JSON, "Content-Encoding": encoding}), {415}, (path, encoding))
    is_problem(server.ask("POST", path, "{}", {**JSON, "Content-Encoding": "gzip"}), {400}, (path, "not packed"))
    try_query(server, contract, path, operation, chance, suffix)
    if slow:
        return
    good = 0
    for i in range(SCENES):
        scene = maker.scene()
        wrong = contract.errors(body["content"]["application/json"]["schema"], scene)
        check.that(not wrong, "a scene made from the schema is of it", wrong[:1], scene)
        answer = server.post(path, scene)
        declared(contract, operation, answer, (path, json.dumps(scene)))
        # Rules over several fields are not the schema's; what takes too long is 504.
        check.that(answer.status in (200, 422, 504), "a scene of the schema is answered", answer.status, answer.body[:300],
                   json.dumps(scene))
        if answer.status == 422:
            check.that("pointer" in answer.json(), "422 names the place", answer.body[:200])
        good += answer.status == 200
    check.that(good >= SCENES // 5, "many scenes of the schema are scenes", path, good, "of", SCENES)


def try_query(server, contract, path, operation, chance, suffix):
    parameters = [contract.found(parameter) for parameter in operation["parameters"]]
    for parameter in parameters:
        if parameter["in"] != "query":
            continue
        good, bad = query_values(contract, parameter, chance)
        join = suffix + "&" if suffix and parameter["name"] not in suffix else "?"
        for value in good:
            query = join + urllib.parse.urlencode({parameter["name"]: value})
            document = {"particles": [{"center": [0, 0, 0], "radius": 1, "density": 1}], "image": SCENE["image"]} \
                if parameter["name"] == "radius" else SCENE
            if parameter["name"] not in ("error", "time_ms", "rung"):
                document = {**document, "accuracy": {"rung": "harris"}}
            answer = server.post(path + query, document)
            declared(contract, operation, answer, (path + query))
            # Not every route has every format.
            # And what takes long may take too long on a busy machine.
            allowed = {200, 400} if parameter["name"] == "format" else {200, 504}
            check.that(answer.status in allowed, "a parameter of the query", path + query, answer.status, answer.body[:200])
        for value in bad:
            query = join + urllib.parse.urlencode({parameter["name"]: value})
            is_problem(server.post(path + query, SCENE), {400, 422}, path + query)
    is_problem(server.post(path + "?no_such_parameter=1", SCENE), {400}, (path, "query"))
    if parameters and any(p["name"] == "width" for p in parameters):
        is_problem(server.post(path + "?width=3&width=4", SCENE), {400}, (path, "twice"))


def break_scenes(server, contract):
    """Every constraint of every object of a scene, one at a time, by the route that computes nothing."""
    smallest = {"cubes": [{"particles": 5, "size": [1, 1, 1], "center": [0, 0, 0], "radius": 0.5}]}
    models = {"CubesCloud": {"cubes": smallest["cubes"]}}
    schemas = contract.document["components"]["schemas"]
    chance = random.Random(SEED)
    maker = Maker(contract, chance)
    cases = list(Breaker(contract, smallest, contract).walk({"$ref": "#/components/schemas/Scene"}, []))
    answer = {"particles": [{"center": [0, 0, 0], "radius": 1, "density": 1}]}
    cases += list(Breaker(contract, answer, contract).walk({"$ref": "#/components/schemas/SceneOfParticles"}, []))
    cases += list(Breaker(contract, answer, contract).of_object(schemas["Particle"], ["particles", 0]))
    cases += list(Breaker(contract, smallest, contract).of_object(schemas["Cube"], ["cubes", 0]))
    for name, schema in schemas["Scene"]["properties"].items():
        for one in Breaker(contract, {}, contract).alternatives(schema):
            if one.get("type") != "object":
                continue
            document = {**smallest, name: {key: maker.value(one["properties"][key], key)
                                           for key in one.get("required", [])}}
            cases += list(Breaker(contract, document, contract).of_object(one, [name]))
    for name in [key for key in schemas if key.endswith("Cloud") and "properties" in schemas[key]]:
        schema = schemas[name]
        cloud = models.get(name) or {key: maker.value(schema["properties"][key], key) for key in schema.get("required", [])}
        document = {"clouds": [cloud]}
        cases += list(Breaker(contract, document, contract).of_object(schema, ["clouds", 0]))
        for member, inner in schema["properties"].items():
            for one in Breaker(contract, {}, contract).alternatives(inner):
                if one.get("type") == "array":
                    one, path = contract.found(one["items"]), ["clouds", 0, member, 0]
                else:
                    path = ["clouds", 0, member]
                if one.get("type") != "object":
                    continue
                value = {key: maker.value(one["properties"][key], key) for key in one.get("required", [])}
                inside = {**cloud, member: [value] if path[-1] == 0 else value}
                cases += list(Breaker(contract, {"clouds": [inside]}, contract).of_object(one, path))
    for document, pointer, what in cases:
        answer = server.post("/v1/plan", document)
        is_problem(answer, {400, 413, 422}, (what, json.dumps(document)[:300]), pointer)
    return len(cases)


def try_jobs(server, contract, chance):
    operation = contract.document["paths"]["/v1/jobs"]["post"]
    document = {"kind": "render", "scene": SCENE}
    for case, pointer, what in Breaker(contract, document, contract).of_object(
            contract.found({"$ref": "#/components/schemas/JobRequest"}), []):
        is_problem(server.post("/v1/jobs", case), {400, 422}, (what, json.dumps(case)[:200]), pointer)
    for kind in ("text/csv", "text/plain", ""):
        is_problem(server.ask("POST", "/v1/jobs", json.dumps(document), {"Content-Type": kind}), {415}, kind)
    is_problem(server.post("/v1/jobs", document, {"Idempotency-Key": "x" * 129}), {400, 422}, "a long key")
    first = server.post("/v1/jobs", document, {"Idempotency-Key": "a"})
    declared(contract, operation, first, "a job")
    check.that(first.status == 202, "a job is taken", first.status, first.body[:200])
    again = server.post("/v1/jobs", document, {"Idempotency-Key": "a"})
    check.that(again.json()["id"] == first.json()["id"], "the same key, the same job")
    is_problem(server.post("/v1/jobs", {**document, "kind": "accuracy"}, {"Idempotency-Key": "a"}), {422}, "another body")
    below = contract.document["paths"]
    place = first.headers["location"]
    events = server.ask("GET", place + "/events")
    declared(contract, below["/v1/jobs/{id}/events"]["get"], events, "events")
    for line in events.body.decode().splitlines():
        if line.startswith("data: "):
            wrong = contract.errors({"$ref": "#/components/schemas/Job"}, json.loads(line[6:]))
            check.that(not wrong, "an event's job", wrong, line)
    declared(contract, below["/v1/jobs/{id}"]["get"], server.ask("GET", place), "a job's state")
    result = server.ask("GET", place + "/result")
    check.that(result.status == 200, "a job's result", result.status)
    declared(contract, below["/v1/jobs/{id}/result"]["get"], result, "a job's result")
    tagged = server.ask("GET", place + "/result", headers={"If-None-Match": result.headers["etag"]})
    declared(contract, below["/v1/jobs/{id}/result"]["get"], tagged, "a job's result, not modified")
    check.that(tagged.status == 304, "a job's result, not modified", tagged.status)
    long = server.post("/v1/jobs", {"kind": "render", "scene": {**SCENE, "image": {"width": 2048, "height": 2048},
                                                                "accuracy": {"rung": "truth"}}})
    early = server.ask("GET", long.headers["location"] + "/result")
    check.that(early.status == 409, "a result that is not there yet", early.status)
    declared(contract, below["/v1/jobs/{id}/result"]["get"], early, "early")
    for status in (204, 404):
        gone = server.ask("DELETE", place)
        check.that(gone.status == status, "DELETE", gone.status)
        declared(contract, below["/v1/jobs/{id}"]["delete"], gone, "DELETE")
    server.ask("DELETE", long.headers["location"])
    # It ends at its next look at its deadline.
    after, until = early, time.monotonic() + 20
    while after.status == 409 and time.monotonic() < until:
        after = server.ask("GET", long.headers["location"] + "/result")
    check.that(after.status in (404, 410), "a cancelled job's result", after.status)
    declared(contract, below["/v1/jobs/{id}/result"]["get"], after, "cancelled")


def try_reading(server, contract, path, operation, job):
    answer = server.ask("GET", named(path, job))
    check.that(answer.status == 200, "GET", path, answer.status)
    declared(contract, operation, answer, path)
    head = server.ask("HEAD", named(path, job))
    check.that(head.status == 200 and not head.body, "HEAD is GET without its body", path, head.status)
    if "etag" in answer.headers:
        kept = server.ask("GET", named(path, job), headers={"If-None-Match": answer.headers["etag"]})
        check.that(kept.status == 304, "not modified", path, kept.status)
        declared(contract, operation, kept, path)
    if "{" in path:
        for other in ("none", "%00", "..", "a" * 500, "%F0%9F%98%80"):
            absent = server.ask("GET", re.sub(r"{\w+}", other, path))
            is_problem(absent, {404}, (path, other))
            if absent.status == 404:
                declared(contract, operation, absent, (path, other))
    is_problem(server.ask("GET", named(path, job), headers={"X-Request-Id": "x", "Expect": "miracle"}), {417}, path)


def try_methods(server, contract, job):
    for path, operations in contract.document["paths"].items():
        allowed = {method.upper() for method in operations if method != "parameters"}
        if "GET" in allowed:
            allowed.add("HEAD")
        allowed.add("OPTIONS")
        for method in METHODS:
            if method in allowed:
                continue
            answer = server.ask(method, named(path, job), "{}" if method in ("POST", "PUT", "PATCH") else None, JSON)
            if method == "HEAD":
                check.that(answer.status == 405, "HEAD of what has no GET", path, answer.status)
            else:
                is_problem(answer, {405}, (method, path))
            said = {one.strip() for one in answer.headers.get("allow", "").split(",")}
            check.that(said == allowed, "Allow is what is declared", path, said, allowed)
            one = next(iter(set(operations) - {"parameters"}))
            declared(contract, operations[one], answer, (method, path), method == "HEAD")
        answer = server.ask("OPTIONS", named(path, job))
        check.that(answer.status == 204 and {one.strip() for one in answer.headers["allow"].split(",")} == allowed,
                   "OPTIONS", path, answer.headers.get("allow"))
        for wrong in (path + "x", path + "/x", "/x" + path, path.upper() if path != "/" else "/X"):
            answer = server.ask("GET", named(wrong, job))
            is_problem(answer, {404}, wrong)


def main():
    chance = random.Random(SEED)
    with Server(AWAN, "--software", "--deadline", "30", "--queue", "64") as server:
        contract = Contract(server.ask("GET", "/openapi.json").json())
        jsonschema.Draft202012Validator.check_schema(contract.document["components"]["schemas"]["Scene"])
        job = server.post("/v1/jobs", {"kind": "render", "scene": SCENE}).json()["id"]
        server.ask("GET", f"/v1/jobs/{job}/events")
        broken = break_scenes(server, contract)
        for path, operations in contract.document["paths"].items():
            if "get" in operations:
                try_reading(server, contract, path, operations["get"], job)
            elif path != "/v1/jobs":
                try_posts(server, contract, path, operations["post"], chance)
        try_jobs(server, contract, chance)
        try_methods(server, contract, job)
        check.that(server.ask("GET", "/healthz").status == 200, "the server lives")
        metrics = server.ask("GET", "/metrics").body.decode()
        check.that('status="500"' not in metrics, "no answer was 500")
        check.that(server.stop() == 0, "the server stops")
    print(f"{check.count} checks, {broken} constraints broken, {check.failures} failures")
    for what, count in sorted(check.said.items()):
        print(f"  {count} x {what}")
    return check.failures > 0


sys.exit(main())
