"""What changes on the page without being built anew: charts that are patched, and the sidebar."""
