// Messages beside the field that they are about. `says(field, words)` shows one, and takes it away where there are no words.
function messagesOf(root) {
  let made = 0;
  const placeOf = (field) => field.closest(".row, .field, .floors") || field;
  return function says(field, words) {
    const place = placeOf(field);
    let message = place.nextElementSibling;
    if (message === null || !message.classList.contains("wrong")) {
      if (words === "") return;
      message = Object.assign(document.createElement("p"), { className: "wrong", id: `x-wrong-${++made}` });
      message.setAttribute("role", "alert");
      place.after(message);
    }
    message.hidden = words === "";
    message.textContent = words;
    if (words === "") field.removeAttribute("aria-describedby");
    else field.setAttribute("aria-describedby", message.id);
  };
}
