"""Parts of files, held to the JSON Schema of the whole: keys, types, choices, ranges; nothing is required."""


def mistakes(value, schema, where=""):
    """What is wrong with a value, as texts; nothing: it fits."""
    if "anyOf" in schema:
        tried = [mistakes(value, choice, where) for choice in schema["anyOf"]]
        return min(tried, key=len)
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if "array" in kinds and isinstance(value, dict):  # [contact.heat] for a heading [[contact]] that is not repeated
        value = [value]
    fits = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
    if kinds and not any(isinstance(value, fits[kind]) and (kind == "boolean") == isinstance(value, bool)
                         for kind in kinds):
        return [f"{where}: {value!r} is no {' or '.join(kinds)}"]
    if "enum" in schema and value not in schema["enum"]:
        return [f"{where}: {value!r} is none of {schema['enum']}"]
    found = []
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        for key, wrong in (("minimum", lambda x, y: x < y), ("maximum", lambda x, y: x > y),
                           ("exclusiveMinimum", lambda x, y: x <= y), ("exclusiveMaximum", lambda x, y: x >= y)):
            if key in schema and wrong(value, schema[key]):
                found.append(f"{where}: {value} against {key} {schema[key]}")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{where}: {len(value)} entries")
        for index, item in enumerate(value):
            found += mistakes(item, schema.get("items", {}), f"{where}[{index}]")
    if isinstance(value, dict):
        further = schema.get("additionalProperties", True)
        for key, item in value.items():
            inner = schema.get("properties", {}).get(key, further if isinstance(further, dict) else None)
            if inner is not None:
                found += mistakes(item, inner, f"{where}.{key}")
            elif further is False:
                found.append(f"{where}: no key '{key}'")
    return found


def sections(schema):
    """All sections of a schema, itself included."""
    yield schema
    for inner in [*schema.get("properties", {}).values(), *schema.get("anyOf", []), schema.get("items"),
                  schema.get("additionalProperties")]:
        if isinstance(inner, dict):
            yield from sections(inner)


def fits(fragment, schemas):
    """Whether a fragment fits some section of some schema; else the least list of mistakes."""
    best = None
    for schema in schemas:
        for section in sections(schema):
            if not set(fragment) <= set(section.get("properties", {})):
                continue
            found = mistakes(fragment, section)
            if not found:
                return []
            best = found if best is None or len(found) < len(best) else best
    if best is None and len(fragment) > 1 and not any(isinstance(value, (dict, list)) and key in ("body", "contact")
                                                      for key, value in fragment.items()):
        return sum((fits({key: value}, schemas) for key, value in fragment.items()), [])  # of several sections
    return best or [f"no section has the keys {', '.join(fragment)}"]
