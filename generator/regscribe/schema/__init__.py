"""Plain values to shape errors: whether this is a map at all, key by key.

`validate` checks a document against the JSON Schema of the map language (`schema_json`), which editors use too;
`language` names another schema of the folder schema/, for the other files that people write.
"""

from regscribe.schema.rules import RULES
from regscribe.schema.schemas import schema_json
from regscribe.schema.validate import validate
from regscribe.schema.wording import inline

__all__ = ["RULES", "inline", "schema_json", "validate"]
