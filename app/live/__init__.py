"""What changes on the page without being rebuilt: charts that are patched, and the sidebar."""
