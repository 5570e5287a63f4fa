"""What a study is shown as: findings, figures, and the files that hold them."""
