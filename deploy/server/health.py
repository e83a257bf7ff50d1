"""Health: whether the server answers."""

from panel.io.liveness import LivenessHandler


async def alive(self):
    """Answer that the server runs. Panel's own handler builds a document where asked for one."""
    self.set_header("Cache-Control", "no-store")
    self.write({"alive": True})


def install():
    """Answer GET and HEAD of /liveness without building anything."""
    LivenessHandler.get = LivenessHandler.head = alive
