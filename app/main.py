"""Entry point of `panel serve app`: one session, one page."""

from app.document import show
from deploy import dashboard
from deploy.patches import plain_serving

dashboard.served = True
plain_serving.prepare()
show()
