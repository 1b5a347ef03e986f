"""What operators on hair have in common."""

import tress

from . import cache, hair

ELEMENTS = {
    "name": "Elements",
    "description": "Helix arcs a strand; 0 is one for each segment",
    "default": 0,
    "min": 0,
    "soft_max": 200,
}
SEED = {"name": "Seed", "description": "Another seed, another result", "default": 0, "min": 0}


class HairOperator:
    """What operators on the active hair have in common."""

    bl_options = {"REGISTER", "UNDO"}

    #: Whether the operator moves hair, which an armature on it or a file would move back.
    moves_hair = False

    @classmethod
    def poll(cls, context):
        if not hair.is_hair(context.object):
            return False
        if cls.moves_hair and hair.REST in context.object.data.attributes:
            cls.poll_message_set("Apply or discard the armature first")
            return False
        if cls.moves_hair and cache.is_played(context.object):
            cls.poll_message_set("Stop playing the file first: it would move the hair back")
            return False
        return True

    def execute(self, context):
        try:
            message = self.run(context, context.object)
        except tress.TressError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if message:
            self.report({"INFO"}, message)
        return {"FINISHED"}
