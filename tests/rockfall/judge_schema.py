# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges JSON documents by a JSON Schema: SCHEMA DOCUMENTS, the second a file with one document a line.
Prints one line a document: good or bad."""
import json
import sys

import jsonschema

with open(sys.argv[1]) as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
with open(sys.argv[2]) as file:
    for line in file:
        print("good" if validator.is_valid(json.loads(line)) else "bad")
